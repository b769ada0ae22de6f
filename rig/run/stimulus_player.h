#pragma once
// Plays sounds, moves and loads during a step, each from its time or temperature on, and records
// when. Those of different instruments may overlap; two of one follow each other: there is one
// speaker, one hand and one board.
#include <optional>
#include <vector>

#include "rig/profile/profile.h"
#include "rig/run/bench.h"
#include "rig/run/run_log.h"
#include "rig/run/stimulus_sound.h"

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
  /// Something plays that a stop on request had better wait for: all but loads.
  bool provoking() const;
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
    Instant from = {}, until = {};
    Sound sound = {};  ///< as last set
  };

  bool Comes(Slot& slot, std::optional<double> board_degc) const;
  bool Busy(const Slot& slot) const;
  Status Begin(Slot& slot);
  /// What is to be done before a stimulus is recorded as begun. kRefused where an instrument
  /// cannot.
  Status Start(const Stimulus& stimulus);
  /// Lets the speaker play what is due now.
  Status Sing(Slot& slot);
  Status End(Slot& slot);

  Bench& bench_;
  RunLog& log_;
  std::vector<Slot> slots_;
  Instant step_start_{};
};

}  // namespace zrobench
