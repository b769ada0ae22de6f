#include "rig/physics/terms/gyro_step.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/per_axis_term.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kWhen = 3;

/// State: time under power [s]. It goes on at a power-on: what has slipped stays where it is.
class GyroStep final : public PerAxisTerm {
 public:
  void Place(const Temperatures&, std::span<double> states) const override { states[0] = 0; }
  void Step(const TermContext& context, std::span<const double>,
            std::span<double> states) const override {
    states[0] += context.sample_period_s;
  }

 protected:
  double Cause(const TermContext&, std::span<const double> parameters,
               std::span<const double> states) const override {
    return states[0] >= parameters[kWhen] ? 1 : 0;
  }
};

std::vector<double> EveryFiveMinutes() {
  std::vector<double> when_s;
  for (int i = 1; i <= 24; ++i) when_s.push_back(300.0 * i);
  return when_s;
}

}  // namespace

TermInfo GyroStepInfo() {
  static const GyroStep term;
  return {
      .id = "gyro.step",
      .sentence = "At one moment the offset jumped, and stayed: stress that slipped.",
      .equation = "y = dps H(t - when), t under power since the beginning",
      .source = "stress slip, popcorn noise; magnitudes: engineering estimate, 1 to 50 mdps",
      .parameters = {PerAxis("dps", "dps", 0.01, "positive jumps up"),
                     Width("when_s", "s", 3600, "time of the jump", EveryFiveMinutes())},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"constant of a power-on", "gyro.warm_up", "gyro.ageing",
                     "gyro.temperature_curve"},
      .excitation = "the same temperatures before and after",
      .states = 1,
      .term = &term,
      .needs = {"gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
