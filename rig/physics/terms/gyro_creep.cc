#include "rig/physics/terms/gyro_creep.h"

#include <cmath>
#include <limits>

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/per_axis_term.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kTau = 3;
constexpr double kSpanK = 40;

/// State: the temperature for which the stress has relaxed [degC]; none before the first step.
class GyroCreep final : public PerAxisTerm {
 public:
  void PowerOn(std::span<double> states) const override {
    states[0] = std::numeric_limits<double>::quiet_NaN();
  }
  void Step(const TermContext& context, std::span<const double> parameters,
            std::span<double> states) const override {
    const double die_degc = context.temperatures.die_degc;
    if (std::isnan(states[0])) states[0] = die_degc;
    states[0] -= (states[0] - die_degc) * -std::expm1(-context.sample_period_s / parameters[kTau]);
  }

 protected:
  double Cause(const TermContext& context, std::span<const double>,
               std::span<const double> states) const override {
    return std::isnan(states[0]) ? 0 : (context.temperatures.die_degc - states[0]) / kSpanK;
  }
};

}  // namespace

TermInfo GyroCreepInfo() {
  static const GyroCreep term;
  return {
      .id = "gyro.creep",
      .sentence =
          "After a step of temperature the offset overshoots and creeps back while the die's "
          "temperature stands still: stress that relaxes.",
      .equation = "y = dps_per_40k (T_d - s) / 40, tau s' = T_d - s, s = T_d at power-on",
      .source =
          "Maxwell relaxation of package stress, one time constant; magnitudes: engineering "
          "estimate, 1 to 20 mdps per 40 K over 100 to 3000 s",
      .parameters = {PerAxis("dps_per_40k", "dps/40K", 0.01,
                             "positive: too high after a step up, too low after one down"),
                     Width("tau_s", "s", 600, "time constant of the relaxation",
                           {100, 200, 400, 800, 1600, 3200})},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.backlash", "gyro.temperature_rate", "thermal.parallel_mass",
                     "gyro.ageing"},
      .excitation = "steps up and down, each with a hold of three time constants",
      .states = 1,
      .term = &term,
      .needs = {"imu_degc", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
