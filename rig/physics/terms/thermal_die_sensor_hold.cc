#include "rig/physics/terms/thermal_die_sensor_hold.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/hold.h"

namespace zrobench::physics {

TermInfo ThermalDieSensorHoldInfo() {
  static const HeldRegister<&Temperatures::die_degc> term;
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
