#include "rig/run/bench.h"

namespace zrobench {

Status MakeSafe(Bench& bench) {
  const auto in = [&](Duration time) { return bench.clock.now() + time; };
  const Status muted = bench.speaker.Mute(in(std::chrono::milliseconds(300)));
  const Status off = bench.plate.MakeSafe(in(std::chrono::seconds(2)));
  const Status on = bench.power ? bench.power->SetOn(true, in(std::chrono::seconds(2))) : Status{};
  if (!muted) return muted;
  return off ? on : off;
}

}  // namespace zrobench
