#include "rig/physics/terms/gyro_g_sensitivity.h"

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

class GyroGSensitivity final : public Term {
 public:
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double>, Sensed& sensed) const override {
    const Inputs& inputs = context.inputs;
    for (std::size_t from = 0; from < 3; ++from) {
      const double felt_g = inputs.gravity_g[from] + inputs.shake_g[from];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sensed.rate_dps[axis] += parameters[3 * from + axis] * felt_g;
      }
    }
  }
};

ParameterInfo From(std::string_view name) {
  return PerAxis(name, "dps/g", 0.01, "positive: the rate grows with this acceleration");
}

}  // namespace

TermInfo GyroGSensitivityInfo() {
  static const GyroGSensitivity term;
  return {
      .id = "gyro.g_sensitivity",
      .sentence = "The offset follows acceleration: it changes when the board is tilted.",
      .equation = "y_i = sum_j k_ij a_j, a = gravity and shake, k_ij = dps_per_g_from_j of axis i",
      .source = "ADXRS645 data sheet: 0.1 dps/g; compensated parts a tenth of it (estimate)",
      .parameters = {From("dps_per_g_from_x"), From("dps_per_g_from_y"), From("dps_per_g_from_z")},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"constant of the cubic", "gyro.vibration_rectification"},
      .excitation = "tilts by known angles at an even temperature",
      .states = 0,
      .term = &term,
      .needs = {"accel_x_g|accel_y_g|accel_z_g", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
