#include "rig/physics/terms/gyro_vibration_rectification.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/per_axis_term.h"

namespace zrobench::physics {
namespace {

class GyroVibrationRectification final : public PerAxisTerm {
 protected:
  double Cause(const TermContext& context, std::span<const double>,
               std::span<const double>) const override {
    const Axes& g = context.inputs.shake_g;
    return g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  }
};

}  // namespace

TermInfo GyroVibrationRectificationInfo() {
  static const GyroVibrationRectification term;
  return {
      .id = "gyro.vibration_rectification",
      .sentence =
          "While the board vibrates the rate shifts by a constant that grows with the square of "
          "the vibration.",
      .equation = "y = dps_per_g2 |a|^2, a = acceleration beside gravity",
      .source = "ADXRS645 data sheet: 0.0006 dps/g^2 (25 g rms, 50 Hz to 5 kHz)",
      .parameters = {PerAxis("dps_per_g2", "dps/g^2", 0.0006, "positive shifts the rate up")},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"acoustic.rectification", "gyro.g_sensitivity"},
      .excitation = "vibration on and off, at two levels: the shift goes with the square",
      .states = 0,
      .term = &term,
      .needs = {"accel_x_g|accel_y_g|accel_z_g", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
