#include "rig/run/bench.h"

namespace zrobench {

Status MakeSafe(Bench& bench) {
  const Instant now = bench.clock.now();
  const Status muted = bench.speaker.Mute(now + std::chrono::milliseconds(300));
  const Status off = bench.plate.MakeSafe(now + std::chrono::seconds(2));
  return muted ? off : muted;
}

}  // namespace zrobench
