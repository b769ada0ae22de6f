#include "corrector/quarantine.h"

#include "corrector/arithmetic.h"

namespace zro {

Quarantine::Quarantine(float sample_hz)
    : least_samples_(SamplesIn(kLeastS, sample_hz)),
      expire_samples_(SamplesIn(kExpireS, sample_hz)) {}

Quarantine::Verdict Quarantine::Add(const Vote& vote) {
  const bool held = votes_ > 0;
  if (held && WorstDifference(vote.shift_dps, shift_dps_).value > vote.tolerance_dps) votes_ = 0;
  const bool starts = votes_ == 0;
  if (starts) first_ = vote.sample;
  if (votes_ < 255) ++votes_;
  last_ = vote.sample;
  const float gain = 1.0f / static_cast<float>(votes_);
  for (int axis = 0; axis < kAxes; ++axis) {
    const float before = starts ? 0.0f : shift_dps_[axis];
    shift_dps_[axis] = before + gain * (vote.shift_dps[axis] - before);
  }
  const bool long_enough = vote.lone || last_ - first_ >= least_samples_;
  if (votes_ >= (vote.lone ? kVotesLone : kVotes) && long_enough) return Verdict::kConfirmed;
  if (!starts) return Verdict::kAgrees;
  return held ? Verdict::kReplaced : Verdict::kFirst;
}

bool Quarantine::Expire(std::uint32_t sample) {
  return votes_ > 0 && sample - last_ > expire_samples_ && Clear();
}

bool Quarantine::Clear() {
  const bool held = votes_ > 0;
  votes_ = 0;
  return held;
}

}  // namespace zro
