#include "rig/physics/terms/gyro_temperature_rate.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/per_axis_term.h"

namespace zrobench::physics {
namespace {

class GyroTemperatureRate final : public PerAxisTerm {
 protected:
  double Cause(const TermContext& context, std::span<const double>,
               std::span<const double>) const override {
    return context.die_k_per_s;
  }
};

}  // namespace

TermInfo GyroTemperatureRateInfo() {
  static const GyroTemperatureRate term;
  return {
      .id = "gyro.temperature_rate",
      .sentence =
          "While the temperature moves the offset stands beside its curve, in proportion to how "
          "fast: gradients within the package.",
      .equation = "y = dps_per_k_per_s T_d'",
      .source =
          "first-order gradient model; magnitudes: engineering estimate, 0.01 to 0.5 dps per K/s",
      .parameters = {PerAxis("dps_per_k_per_s", "dps/(K/s)", 0.05,
                             "positive: the rate is higher while it warms")},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.creep", "gyro.backlash", "time.latency", "thermal.die_sensor_hold"},
      .excitation = "ramps of several rates, and holds, in which it vanishes at once",
      .states = 0,
      .term = &term,
      .needs = {"imu_degc", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
