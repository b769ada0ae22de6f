#include "corrector/reading.h"

#include "corrector/arithmetic.h"
#include "corrector/stillness.h"

namespace zro {
namespace {

// Averaging does not remove flicker (bias instability) nor the temperature's own resolution: a
// longer window cannot make a reading better than this.
constexpr float kFloorDps = 0.002f;

}  // namespace

Reading::Reading(float sample_hz)
    : sample_hz_(sample_hz), guard_samples_(SamplesIn(kGuardS, sample_hz)) {}

void Reading::Restart(std::uint32_t target) {
  const float hz = sample_hz_;
  const std::uint32_t guard = guard_samples_;
  *this = Reading(hz);
  guard_samples_ = guard;
  target_ = target < 16 ? 16 : target;  // fewer give no variance worth comparing
}

void Reading::Note(const Sample& sample, bool temp_valid) {
  if (sample.elapsed > 1) lost_ += sample.elapsed - 1;
  if (sample.overrun) ++lost_;
  if (sample.gyro_clipped || sample.accel_clipped) ++clipped_;
  if (!temp_valid) ++bad_temperatures_;
}

void Reading::Average(const Sample& sample, float temp_degc, bool temp_valid) {
  ++n_;
  const float gain = 1.0f / static_cast<float>(n_);
  for (int axis = 0; axis < kAxes; ++axis) {
    const float before = sample.rate_dps[axis] - mean_dps_[axis];
    mean_dps_[axis] += gain * before;
    squares_[axis] += before * (sample.rate_dps[axis] - mean_dps_[axis]);
  }
  if (!temp_valid) return;
  ++temperatures_;
  if (temperatures_ == 1) mean_degc_ = least_degc_ = most_degc_ = temp_degc;
  mean_degc_ += (temp_degc - mean_degc_) / static_cast<float>(temperatures_);
  least_degc_ = Min(least_degc_, temp_degc);
  most_degc_ = Max(most_degc_, temp_degc);
}

void Reading::Add(const Sample& sample, float temp_degc, bool temp_valid) {
  if (target_ == 0) return;
  if (n_ >= target_) {
    ++guard_;
    return;
  }
  Note(sample, temp_valid);
  if (!IsUsable(sample)) {
    ++lost_;
    return;
  }
  Average(sample, temp_degc, temp_valid);
  if (n_ != target_ / 2) return;
  half_n_ = n_;
  half_degc_ = mean_degc_;
  for (int axis = 0; axis < kAxes; ++axis) half_dps_[axis] = mean_dps_[axis];
}

Summary Reading::Summarise() const {
  Summary s{};
  const float n = static_cast<float>(n_);
  const float to_halves = n / (n - static_cast<float>(half_n_));  // mean - first -> second - first
  float worst = 0.0f;
  for (int axis = 0; axis < kAxes; ++axis) {
    s.zro_dps[axis] = mean_dps_[axis];
    s.std_dps[axis] = sqrtf(squares_[axis] / (n - 1.0f));
    s.drift_dps[axis] = (mean_dps_[axis] - half_dps_[axis]) * to_halves;
    worst = Max(worst, s.std_dps[axis]);
  }
  s.temp_degc = mean_degc_;
  s.temp_spread_degc = most_degc_ - least_degc_;
  s.slope_degc_per_s = (mean_degc_ - half_degc_) * to_halves * 2.0f * sample_hz_ / n;
  s.sigma_dps = sqrtf(worst * worst / n + kFloorDps * kFloorDps);
  s.samples = n_;
  s.lost = lost_;
  s.clipped = clipped_;
  s.bad_temperatures = bad_temperatures_;
  return s;
}

}  // namespace zro
