#include "rig/physics/terms/time_sample_hold.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/hold.h"

namespace zrobench::physics {

TermInfo TimeSampleHoldInfo() {
  static const HeldRegister<&Temperatures::plate_degc> term;
  return {
      .id = "time.sample_hold",
      .sentence =
          "The controller fills the plate's register now and then: between, it repeats itself.",
      .equation = "y = T_p at the last multiple of hold_s; 0 = none",
      .source =
          "process values of controllers are refreshed every 0.1 to 1 s (engineering estimate)",
      .parameters = {Amount("hold_s", "s", 1, "time between refreshes; 0 = none",
                            {0.5, 1, 2, 5, 10})},
      .borrows = {},
      .channels = {"plate_degc"},
      .lookalikes = {"thermal.plate_sensor_lag", "thermal.dead_time"},
      .excitation = "ramps, sampled faster than it holds: runs of equal values",
      .states = kHoldStates,
      .term = &term,
      .needs = {"plate_degc", "drive_pct|imu_degc"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
