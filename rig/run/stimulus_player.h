#pragma once
// Plays tones and moves during a step, each from its time or temperature on, and records when. A
// tone and a move may overlap; two of a kind follow each other: there is one speaker and one hand.
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
  /// One more, from now on.
  void Add(const Stimulus& stimulus) { slots_.push_back({.stimulus = stimulus}); }
  /// Starts what is due and ends what is over. `board_degc` decides at_degc: a stimulus starts when
  /// the temperature passes it in either direction.
  Status Update(std::optional<double> board_degc);
  bool playing() const;
  /// How many have not begun yet.
  int waiting() const;
  /// Ends those that play (a stop on request); the first failure.
  Status Abort();

 private:
  struct Slot {
    enum class State { kWaiting, kDue, kPlaying, kOver };
    Stimulus stimulus;
    State state = State::kWaiting;
    std::optional<bool> was_below = std::nullopt;  ///< board below at_degc when last looked
    Instant until = {};
  };

  bool Comes(Slot& slot, std::optional<double> board_degc) const;
  bool Busy(const Slot& slot) const;
  Status Begin(Slot& slot);
  Status End(Slot& slot);

  Bench& bench_;
  RunLog& log_;
  std::vector<Slot> slots_;
  Instant step_start_{};
};

}  // namespace zrobench
