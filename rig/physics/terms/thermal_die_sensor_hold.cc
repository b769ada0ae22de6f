#include "rig/physics/terms/thermal_die_sensor_hold.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/hold.h"

namespace zrobench::physics {
namespace {

class ThermalDieSensorHold final : public Term {
 public:
  void Place(const Temperatures& at, std::span<double> states) const override {
    PlaceHold(at.die_degc, states);
  }
  void Show(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, Temperatures& shown) const override {
    shown.die_degc = HeldValue(shown.die_degc, parameters[0], context.dt_s, states);
  }
};

}  // namespace

TermInfo ThermalDieSensorHoldInfo() {
  static const ThermalDieSensorHold term;
  return {
      .id = "thermal.die_sensor_hold",
      .sentence =
          "The die's temperature is measured now and then and held in between: on ramps it reads "
          "late.",
      .equation = "y = T_d at the last multiple of hold_s; 0 = none",
      .source = "BMI088 data sheet: the temperature register is refreshed every 1.28 s",
      .parameters = {Amount("hold_s", "s", 1.28, "time between measurements; 0 = none",
                            {0.5, 1.28, 2.5, 5, 10})},
      .borrows = {},
      .channels = {"imu_degc"},
      .lookalikes = {"gyro.temperature_rate", "time.latency", "gyro.backlash"},
      .excitation = "ramps of several rates, sampled faster than it holds",
      .states = kHoldStates,
      .term = &term,
      .needs = {"imu_degc"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
