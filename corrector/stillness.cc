#include "corrector/stillness.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

// A quarter of each new sample: noise falls to 0.38, motion is seen within a few samples.
constexpr float kSmoothing = 0.25f;
constexpr float kSaneDps = 5000.0f;
constexpr float kSaneG = 500.0f;

}  // namespace

bool IsUsable(const Sample& sample) {
  for (int axis = 0; axis < kAxes; ++axis) {
    if (!IsSane(sample.rate_dps[axis], kSaneDps)) return false;
    if (!IsSane(sample.accel_g[axis], kSaneG)) return false;
  }
  return true;
}

Stillness::Stillness(float sample_hz)
    : declare_samples_(SamplesIn(kDeclareS, sample_hz)),
      mean_samples_(SamplesIn(kMeanS, sample_hz)),
      lost_samples_(SamplesIn(kLostS, sample_hz)) {}

bool Stillness::Break(const Interruption& why) {
  const bool was_still = still();
  quiet_ = 0;
  unusable_ = 0;
  if (was_still) interruption_ = why;
  return was_still;
}

void Stillness::CountQuiet() {
  if (quiet_ < declare_samples_ || quiet_ < mean_samples_) ++quiet_;
}

bool Stillness::Lose(const Sample& sample) {
  const bool clipped = sample.gyro_clipped || sample.accel_clipped;
  if (++unusable_ <= lost_samples_) {
    if (quiet_ > 0) CountQuiet();  // a short glitch spoils a reading, not the stillness
    return false;
  }
  return Break({clipped ? Code::kClipped : Code::kSampleGap, kNoAxis,
                static_cast<float>(lost_samples_ + 1), static_cast<float>(lost_samples_)});
}

void Stillness::Smooth(const Sample& sample) {
  const float gain = primed_ ? kSmoothing : 1.0f;
  primed_ = true;
  for (int axis = 0; axis < kAxes; ++axis) {
    smooth_g_[axis] += gain * (sample.accel_g[axis] - smooth_g_[axis]);
    smooth_dps_[axis] += gain * (sample.rate_dps[axis] - smooth_dps_[axis]);
  }
}

bool Stillness::Departs(float limit_g, Interruption* why) const {
  const Worst g = WorstDifference(smooth_g_, mean_g_);
  if (g.value > limit_g) {
    *why = {Code::kMotion, g.axis, g.value, limit_g};
    return true;
  }
  const Worst dps = WorstDifference(smooth_dps_, mean_dps_);
  if (dps.value > kTurnDps) {
    *why = {Code::kMotion, dps.axis, dps.value, kTurnDps};
    return true;
  }
  return false;
}

bool Stillness::Step(const Sample& sample, float limit_g) {
  if (sample.elapsed > lost_samples_) {
    primed_ = false;
    return Break({Code::kSampleGap, kNoAxis, static_cast<float>(sample.elapsed),
                  static_cast<float>(lost_samples_)});
  }
  if (!IsUsable(sample) || sample.gyro_clipped || sample.accel_clipped) return Lose(sample);
  unusable_ = 0;
  Smooth(sample);
  bool ended = false;
  Interruption why{};
  if (quiet_ > 0 && Departs(limit_g, &why)) ended = Break(why);
  CountQuiet();
  const std::uint32_t n = quiet_ < mean_samples_ ? quiet_ : mean_samples_;
  const float gain = 1.0f / static_cast<float>(n);
  for (int axis = 0; axis < kAxes; ++axis) {
    mean_g_[axis] += gain * (smooth_g_[axis] - mean_g_[axis]);
    mean_dps_[axis] += gain * (smooth_dps_[axis] - mean_dps_[axis]);
  }
  return ended;
}

}  // namespace zro
