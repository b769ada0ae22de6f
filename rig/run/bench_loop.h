#pragma once
// The controller's heartbeat: waits, pumps the bus, reads the plate once a second, follows the
// set-point ramp, plays stimuli, watches over the bench. Steps (rig/run/steps.h) only say what for.
#include <optional>
#include <vector>

#include "rig/profile/profile.h"
#include "rig/run/bench.h"
#include "rig/run/halt.h"
#include "rig/run/run_log.h"
#include "rig/run/stimulus_player.h"

namespace zrobench {

class BenchLoop {
 public:
  /// All borrowed.
  BenchLoop(Bench& bench, const Station& station, RunLog& log, const StopRequest& stop);

  /// Runs the bench until `until` (and no shorter, unless halted).
  Flow RunUntil(Instant until);
  Flow RunFor(double seconds) { return RunUntil(now() + FromSeconds(seconds)); }
  /// One tick (0.1 s): for loops that end on a condition.
  Flow Tick();

  /// Set point from here on: `degc` at once, or along a ramp from the present set point.
  Flow SetTarget(double degc);
  Flow StartRamp(double to_degc, double rate_degc_per_min);
  bool ramping() const { return ramp_.has_value(); }

  StimulusPlayer& stimuli() { return stimuli_; }
  Bench& bench() { return bench_; }
  RunLog& log() { return log_; }
  Instant now() const { return bench_.clock.now(); }
  const ThermalPlate::Reading& plate() const { return plate_; }
  /// Board temperature as the bus last showed it; absent while the board is silent.
  std::optional<double> board_degc() const;

  /// The board is meant to be silent (power off) and to boot after it: no watch over its frames.
  void ExpectSilence(bool silent);
  /// A boot-up message is meant to come; when it came (false), any other is an alarm.
  void ExpectBoot(bool expected);
  /// Takes the board's new decisions into the record.
  Flow ReadDecisions();
  /// The board's table, not recorded.
  Result<TableSnapshot> PeekTable();
  /// Writes a table just read into the record; `when` as in TableItem.
  void Record(std::uint8_t when, const TableSnapshot& table);
  /// Both.
  Flow ReadTable(std::uint8_t when);

 private:
  struct RampPlan {
    double from_degc, to_degc, rate_degc_per_s;
    Instant start;
  };

  Flow EverySecond();
  Flow FollowRamp();
  Flow Watch();
  void WatchBoots();
  void WatchWallTime();
  Flow RefuseCondensation(double degc) const;
  double ReadAir();
  Flow CheckStop() const;

  Bench& bench_;
  const Station& station_;
  RunLog& log_;
  const StopRequest& stop_;
  StimulusPlayer stimuli_;
  ThermalPlate::Reading plate_;
  std::optional<RampPlan> ramp_;
  std::optional<double> target_degc_;  ///< absent until the first set point
  std::optional<double> dew_point_degc_;
  Instant next_second_{};
  Instant next_decisions_{};
  Instant last_alive_{};
  Instant next_snapshot_{};
  UtcNs last_utc_;
  bool silence_expected_ = false;
  bool boot_expected_ = false;
  std::uint32_t boots_ = 0;
};

}  // namespace zrobench
