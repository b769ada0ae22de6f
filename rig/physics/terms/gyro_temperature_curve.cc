#include "rig/physics/terms/gyro_temperature_curve.h"

#include <algorithm>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kQuartic = 0, kKink = 3, kKinkDegc = 6;
constexpr double kReferenceDegc = 25, kSpanK = 40;

/// The two ways in which a single-valued curve leaves a cubic: smoothly, by its next power, and
/// sharply, by a bend. A reference other than the cubic's is only another cubic.
class GyroTemperatureCurve final : public Term {
 public:
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double>, Sensed& sensed) const override {
    const double die_degc = context.temperatures.die_degc;
    const double x = (die_degc - kReferenceDegc) / kSpanK;
    const double beyond_k = std::max(0.0, die_degc - parameters[kKinkDegc]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sensed.rate_dps[axis] += parameters[kQuartic + axis] * x * x * x * x;
      sensed.rate_dps[axis] += parameters[kKink + axis] * beyond_k;
    }
  }
};

}  // namespace

TermInfo GyroTemperatureCurveInfo() {
  static const GyroTemperatureCurve term;
  return {
      .id = "gyro.temperature_curve",
      .sentence =
          "The offset is a function of temperature, but not a cubic: it bends more towards the "
          "ends, or has a kink.",
      .equation = "y = dps_quartic x^4 + dps_per_k max(0, T_d - kink), x = (T_d - 25) / 40",
      .source =
          "PX4 corrects with a cubic per axis; degree of the polynomial: Guenhan and Uensal 2014; "
          "magnitudes: engineering estimate, 1 to 20 mdps",
      .parameters = {PerAxis("dps_quartic", "dps", 0.005, "positive bends the curve up"),
                     PerAxis("dps_per_k", "dps/K", 0.0005, "positive: steeper above the kink"),
                     Location("kink_degc", "degC", 40, "die temperature of the kink",
                              {0, 10, 20, 30, 40, 50, 60})},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.hysteresis", "acoustic.resonance_drift", "gyro.quantisation"},
      .excitation = "up and down over the whole range: one value at each temperature",
      .states = 0,
      .term = &term,
      .needs = {"imu_degc", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
