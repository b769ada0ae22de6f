#include "rig/physics/terms/time_latency.h"

#include "rig/physics/terms/delay_line.h"
#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

class TimeLatency final : public Term {
 public:
  void Place(const Temperatures& at, std::span<double> states) const override {
    DelayLine past(states);
    past.Clear();
    past.AppendPoint(at.die_degc, 0, 0);
  }
  void Show(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, Temperatures& shown) const override {
    const double delay_s = parameters[0];
    if (delay_s <= 0 || context.dt_s <= 0) return;
    DelayLine past(states);
    past.AppendPoint(shown.die_degc, context.dt_s, delay_s);
    shown.die_degc = past.At(delay_s);
  }
};

}  // namespace

TermInfo TimeLatencyInfo() {
  static const TimeLatency term;
  return {
      .id = "time.latency",
      .sentence =
          "The die's temperature is stamped when it arrives, not when it was measured; no other "
          "channel is late.",
      .equation = "y(t) = T_d(t - latency_s)",
      .source = "queues of a sensor hub hold up to seconds (engineering estimate)",
      .parameters = {Amount("latency_s", "s", 1, "0 = none")},
      .borrows = {},
      .channels = {"imu_degc"},
      .lookalikes = {"gyro.temperature_rate", "thermal.die_sensor_hold", "thermal.series_mass"},
      .excitation = "ramps of several rates, and fast edges",
      .states = DelayLine::kStates,
      .term = &term,
      .needs = {"imu_degc"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
