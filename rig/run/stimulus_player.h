#pragma once
// Plays tones and moves during a step, each from its time or temperature on, and records when.
#include <optional>
#include <vector>

#include "rig/profile/profile.h"
#include "rig/run/bench.h"
#include "rig/run/run_log.h"

namespace zrobench {

class StimulusPlayer {
 public:
  StimulusPlayer(Bench& bench, RunLog& log) : bench_(bench), log_(log) {}

  /// Stimuli of the step that begins now; those of the step before are forgotten.
  void Schedule(const std::vector<Stimulus>& stimuli);
  /// Starts what is due and ends what is over. `board_degc` decides at_degc: a stimulus starts when
  /// the temperature passes it in either direction.
  Status Update(std::optional<double> board_degc);
  bool playing() const { return playing_.has_value(); }
  /// How many have not begun yet.
  int waiting() const;
  /// Ends the one that plays (a stop on request).
  Status Abort();

 private:
  struct Slot {
    Stimulus stimulus;
    bool begun = false;
    std::optional<bool> was_below;  ///< board below at_degc when last looked
  };
  struct Playing {
    Stimulus stimulus;
    Instant until;
  };

  bool Due(Slot& slot, std::optional<double> board_degc) const;
  Status Begin(const Stimulus& stimulus);
  Status End();

  Bench& bench_;
  RunLog& log_;
  std::vector<Slot> slots_;
  std::optional<Playing> playing_;
  Instant step_start_{};
};

}  // namespace zrobench
