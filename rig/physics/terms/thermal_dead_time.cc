#include "rig/physics/terms/thermal_dead_time.h"

#include "rig/physics/terms/delay_line.h"
#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

class ThermalDeadTime final : public Term {
 public:
  void Place(const Temperatures&, std::span<double> states) const override {
    DelayLine(states).Clear();
  }
  double Drive(const HeatContext& context, std::span<const double> parameters,
               std::span<double> states, double drive_pct) const override {
    const double delay_s = parameters[0];
    if (delay_s <= 0 || context.dt_s <= 0) return drive_pct;
    DelayLine past(states);
    past.AppendHeld(drive_pct, context.dt_s, delay_s);
    return past.MeanOfStep(context.dt_s, delay_s);
  }
};

}  // namespace

TermInfo ThermalDeadTimeInfo() {
  static const ThermalDeadTime term;
  return {
      .id = "thermal.dead_time",
      .sentence = "The plate answers its drive late: polling, a slow controller, slow pulses.",
      .equation = "Q(t) -> Q(t - dead_time); before the beginning the drive was as it began",
      .source = "controller, poll and pulse period add up to 0.5 to 10 s (engineering estimate)",
      .parameters = {Amount("dead_time_s", "s", 2, "0 = none")},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"thermal.plate_sensor_lag", "thermal.series_mass", "time.latency"},
      .excitation = "fast edges of the drive",
      .states = DelayLine::kStates,
      .term = &term,
      .needs = {"plate_degc|imu_degc", "drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
