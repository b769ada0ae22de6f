#pragma once
// What the speaker shall play a while into a stimulus.
#include "rig/profile/profile.h"

namespace zrobench {

/// A sine, or noise of `band_hz` about `hz`; at rest (v = 0) for what does not sound.
struct Sound {
  double hz = 0, v = 0, spl_db = 0, band_hz = 0;
  bool operator==(const Sound&) const = default;
};

bool Sounds(const Stimulus& stimulus);
/// `into_s` seconds after its begin. Music is played in passages of 2 s, loud and soft by a fixed
/// score: what must be refused may come at any level.
Sound SoundAt(const Stimulus& stimulus, double into_s);

}  // namespace zrobench
