#include "rig/physics/terms/gyro_quantisation.h"

#include <cmath>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

/// Acts on all that stands before it, noise included; the model lists it last.
class GyroQuantisation final : public Term {
 public:
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double>, Sensed& sensed) const override {
    const double step_dps = parameters[0];
    if (step_dps <= 0 || context.truth) return;
    for (double& rate_dps : sensed.rate_dps) rate_dps = step_dps * std::round(rate_dps / step_dps);
  }
};

}  // namespace

TermInfo GyroQuantisationInfo() {
  static const GyroQuantisation term;
  return {
      .id = "gyro.quantisation",
      .sentence =
          "The rate comes in steps too coarse for its noise: its mean follows the true value in "
          "stairs.",
      .equation = "y = step round(y / step); 0 = none",
      .source =
          "quantisation without dither (Widrow 1956): unbiased from 0.5 step of noise on; steps of "
          "1/131 to 1/16.4 dps in common ranges",
      .parameters = {Amount("step_dps", "dps", 1 / 131.0, "distance of the values",
                            {1 / 131.0, 1 / 65.5, 1 / 32.8, 1 / 16.4})},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.temperature_curve"},
      .excitation = "a slow ramp with little noise; another range of the gyro",
      .states = 0,
      .term = &term,
      .needs = {"gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .linear = false,
      .needs_every_sample = true,
      .scanned = false,
  };
}

}  // namespace zrobench::physics
