#pragma once
// Takes the bench through a profile, step by step, and always leaves it safe.
#include "rig/profile/profile.h"
#include "rig/run/bench_loop.h"

namespace zrobench {

class Sequencer {
 public:
  Sequencer(const Profile& profile, BenchLoop& loop) : profile_(profile), loop_(loop) {}

  /// Runs every step; on every way out, exceptions included, stimuli are ended and the bench is
  /// made safe. A bench that cannot be made safe is a rig fault.
  Flow Execute();
  int steps_completed() const { return steps_completed_; }

 private:
  Flow Begin();
  Flow KnowTheStart();
  /// Ends a run that needs a load before anything moves, where the board has none.
  Flow FindLoad();
  Flow RunSteps();
  Flow FinishStimuli();
  Flow End();
  void WriteEnd(const Flow& flow);

  const Profile& profile_;
  BenchLoop& loop_;
  int steps_completed_ = 0;
};

}  // namespace zrobench
