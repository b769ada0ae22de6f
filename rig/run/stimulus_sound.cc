#include "rig/run/stimulus_sound.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace zrobench {
namespace {

constexpr double kPassage_s = 2;
constexpr std::array<double, 8> kScore_db = {0, -6, -2, -12, 0, -20, -4, -9};
constexpr double kRounding = 1e-6;  ///< clock ticks in front of a whole number

Sound SoundOf(const Tone& tone, double) { return {tone.hz, tone.v, tone.spl_db, 0}; }

Sound SoundOf(const Music& music, double into_s) {
  const auto passage = static_cast<std::size_t>(into_s / kPassage_s + kRounding);
  const double gain_db = kScore_db[passage % kScore_db.size()];
  return {(music.low_hz + music.high_hz) / 2, music.v * std::pow(10, gain_db / 20),
          music.spl_db + gain_db, music.high_hz - music.low_hz};
}

Sound SoundOf(const Sweep& sweep, double into_s) {
  const double tone = std::floor(into_s / sweep.dwell_s + kRounding);
  return {sweep.HzOf(std::min(tone, sweep.tones() - 1)), sweep.v, sweep.spl_db, 0};
}

template <typename Silent>
Sound SoundOf(const Silent&, double) {
  return {};
}

}  // namespace

bool Sounds(const Stimulus& stimulus) { return SoundAt(stimulus, 0).v > 0; }

Sound SoundAt(const Stimulus& stimulus, double into_s) {
  return std::visit([&](const auto& what) { return SoundOf(what, into_s); }, stimulus.what);
}

}  // namespace zrobench
