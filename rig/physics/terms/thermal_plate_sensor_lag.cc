#include "rig/physics/terms/thermal_plate_sensor_lag.h"

#include <cmath>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

/// States: what the sensor shows, and the plate at the step before [degC].
class ThermalPlateSensorLag final : public Term {
 public:
  void Place(const Temperatures& at, std::span<double> states) const override {
    states[0] = states[1] = at.plate_degc;
  }
  void Show(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, Temperatures& shown) const override {
    const double tau_s = parameters[0];
    if (tau_s <= 0 || context.dt_s <= 0) return;
    // Exact for a plate that moves in a straight line over the step: right for small lags, too.
    const double behind_k = tau_s * (shown.plate_degc - states[1]) / context.dt_s;
    const double kept = std::exp(-context.dt_s / tau_s);
    states[0] = shown.plate_degc - behind_k + (states[0] - states[1] + behind_k) * kept;
    states[1] = shown.plate_degc;
    shown.plate_degc = states[0];
  }
};

}  // namespace

TermInfo ThermalPlateSensorLagInfo() {
  static const ThermalPlateSensorLag term;
  return {
      .id = "thermal.plate_sensor_lag",
      .sentence = "The plate's sensor follows the plate slowly; board and die know nothing of it.",
      .equation = "lag y' = T_p - y, y is what the plate's sensor shows",
      .source = "PT100 in a well 2 to 20 s, thermistor 1 to 5 s (engineering estimate)",
      .parameters = {Amount("lag_s", "s", 3, "0 = none")},
      .borrows = {},
      .channels = {"plate_degc"},
      .lookalikes = {"thermal.dead_time", "time.sample_hold", "thermal.plate_sensor_gain"},
      .excitation = "fast edges, seen by the plate and by the die",
      .states = 2,
      .term = &term,
      .needs = {"plate_degc", "imu_degc|drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
