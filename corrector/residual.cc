#include "corrector/residual.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

// Two readings in a row weigh as one of half the variance; what lag and hysteresis add in the
// minutes between them is followed by half at once.
constexpr float kLeastGain = 0.5f;

}  // namespace

void Residual::Take(const Summary& reading, const Estimate& prior, const float table_dps[kAxes],
                    std::uint32_t sample) {
  const float doubt = Square(prior.sigma_dps);
  const float gain =
      prior.valid ? Max(kLeastGain, doubt / (doubt + Square(reading.sigma_dps))) : 1.0f;
  for (int axis = 0; axis < kAxes; ++axis) {
    const float now = prior.zro_dps[axis] + gain * (reading.zro_dps[axis] - prior.zro_dps[axis]);
    difference_dps_[axis] = now - table_dps[axis];
  }
  temp_degc_ = reading.temp_degc;
  sample_ = sample;
  held_ = true;
}

void Residual::Expire(std::uint32_t sample) {
  if (held_ && static_cast<float>(sample - sample_) >= fade_samples_) held_ = false;
}

void Residual::AddTo(float zro_dps[kAxes], float temp_degc, std::uint32_t sample) const {
  if (!held_) return;
  const float by_time = 1.0f - static_cast<float>(sample - sample_) / fade_samples_;
  const float by_temp = 1.0f - fabsf(temp_degc - temp_degc_) / kFadeDegc;
  if (by_time <= 0.0f || by_temp <= 0.0f) return;
  const float share = by_time * by_temp;
  for (int axis = 0; axis < kAxes; ++axis) zro_dps[axis] += share * difference_dps_[axis];
}

}  // namespace zro
