#include "rig/physics/terms/time_sample_hold.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/hold.h"

namespace zrobench::physics {
namespace {

class TimeSampleHold final : public Term {
 public:
  void Place(const Temperatures& at, std::span<double> states) const override {
    PlaceHold(at.plate_degc, states);
  }
  void Show(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, Temperatures& shown) const override {
    shown.plate_degc = HeldValue(shown.plate_degc, parameters[0], context.dt_s, states);
  }
};

}  // namespace

TermInfo TimeSampleHoldInfo() {
  static const TimeSampleHold term;
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
