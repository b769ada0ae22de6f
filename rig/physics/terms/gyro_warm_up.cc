#include "rig/physics/terms/gyro_warm_up.h"

#include <cmath>

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/per_axis_term.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kTau = 3;

/// State: time since power-on [s].
class GyroWarmUp final : public PerAxisTerm {
 public:
  void PowerOn(std::span<double> states) const override { states[0] = 0; }
  void Step(const TermContext& context, std::span<const double>,
            std::span<double> states) const override {
    states[0] += context.sample_period_s;
  }

 protected:
  double Cause(const TermContext&, std::span<const double> parameters,
               std::span<const double> states) const override {
    return std::exp(-states[0] / parameters[kTau]);
  }
};

}  // namespace

TermInfo GyroWarmUpInfo() {
  static const GyroWarmUp term;
  return {
      .id = "gyro.warm_up",
      .sentence =
          "Each power-on begins with an offset that dies away, whatever the temperature does.",
      .equation = "y = dps exp(-t / tau), t since power-on",
      .source =
          "turn-on transient of the drive loop and of charge; magnitudes: engineering estimate, 2 "
          "to 50 mdps over 30 to 1500 s",
      .parameters = {PerAxis("dps", "dps", 0.02, "positive: the rate begins too high"),
                     Width("tau_s", "s", 300, "time constant of its decay",
                           {30, 60, 120, 250, 500, 1000, 2000})},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.ageing", "thermal.self_heating", "gyro.step"},
      .excitation = "power cycles at an even temperature; each a few time constants long",
      .states = 1,
      .term = &term,
      .needs = {"gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .from_power_on = true,
  };
}

}  // namespace zrobench::physics
