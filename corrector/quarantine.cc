#include "corrector/quarantine.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

constexpr float kAgreeDps = 0.015f;  // a genuine shift need not be the same at all temperatures
constexpr float kAgreeSigmas = 3.0f;

}  // namespace

Quarantine::Quarantine(float sample_hz)
    : least_samples_(SamplesIn(kLeastS, sample_hz)),
      expire_samples_(SamplesIn(kExpireS, sample_hz)) {}

bool Quarantine::Agrees(const Vote& vote) const {
  const float joint = sqrtf(Square(vote.sigma_dps) + Square(sigma_dps_));
  const float tolerance = Min(kAgreeDps + kAgreeSigmas * joint, vote.most_dps);
  return votes_ > 0 && WorstDifference(vote.shift_dps, shift_dps_).value <= tolerance;
}

Quarantine::Verdict Quarantine::Add(const Vote& vote) {
  const bool held = votes_ > 0;
  if (!Agrees(vote)) Clear();
  const bool starts = votes_ == 0;
  if (starts) first_ = vote.sample;
  if (votes_ < 255) ++votes_;
  last_ = vote.sample;
  sigma_dps_ = vote.sigma_dps;
  const float gain = 1.0f / static_cast<float>(votes_);
  float size = 0.0f;
  for (int axis = 0; axis < kAxes; ++axis) {
    const float before = starts ? 0.0f : shift_dps_[axis];
    shift_dps_[axis] = before + gain * (vote.shift_dps[axis] - before);
    size = Max(size, fabsf(shift_dps_[axis]));
  }
  const float allowed = static_cast<float>(votes_ + 1 - kFollowVotes) * kFollowEachDps;
  follows_ = vote.clean && votes_ >= kFollowVotes && (size <= allowed || votes_ >= kVotes);
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
  follows_ = false;
  return held;
}

}  // namespace zro
