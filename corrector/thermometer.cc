#include "corrector/thermometer.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

constexpr float kCoarsestDegc = 1.25f;  // a greater change is a jump, not a step
constexpr float kDitherS = 15.0f;       // noise about a boundary crosses it several times

}  // namespace

Thermometer::Thermometer(float sample_hz)
    : step_degc_(2.0f * kCoarsestDegc), dither_samples_(SamplesIn(kDitherS, sample_hz)) {}

void Thermometer::Cross(float boundary_degc, std::uint32_t sample) {
  const bool again =
      crossings_ > 0 && boundary_degc == boundary_degc_[0] && sample - at_[0] < dither_samples_;
  if (!again) {
    for (int i = kCrossings - 1; i > 0; --i) {
      boundary_degc_[i] = boundary_degc_[i - 1];
      at_[i] = at_[i - 1];
    }
    if (crossings_ < kCrossings) ++crossings_;
  }
  boundary_degc_[0] = boundary_degc;
  at_[0] = sample;
}

float Thermometer::Carried(std::uint32_t sample) const {
  if (crossings_ == 0) return shown_degc_;
  const float b0 = boundary_degc_[0];
  if (crossings_ == 1) return 0.5f * (b0 + shown_degc_);
  const float since = static_cast<float>(sample - at_[0]);
  const float first = static_cast<float>(at_[0] - at_[1]);
  const float rate = (b0 - boundary_degc_[1]) / first;
  float span = first;
  float carried = b0 + rate * since;
  if (crossings_ == 3) {
    const float second = static_cast<float>(at_[1] - at_[2]);
    const float rate_before = (boundary_degc_[1] - boundary_degc_[2]) / second;
    span += second;
    carried += (rate - rate_before) / span * since * (since + first);
  }
  const float half = 0.5f * step_degc_;
  carried = Clamp(carried, shown_degc_ - half, shown_degc_ + half);
  const float trust = Clamp(2.0f - since / span, 0.0f, 1.0f);
  return shown_degc_ + trust * (carried - shown_degc_);
}

float Thermometer::Take(float shown_degc, std::uint32_t sample) {
  const float change = fabsf(shown_degc - shown_degc_);
  if (change > 0.0f && started_) {
    step_degc_ = Min(step_degc_, change);
    if (change <= 1.5f * step_degc_) {
      Cross(0.5f * (shown_degc + shown_degc_), sample);
    } else {
      crossings_ = 0;
    }
  }
  started_ = true;
  shown_degc_ = shown_degc;
  if (step_degc_ < kFineDegc || step_degc_ > kCoarsestDegc) return shown_degc;
  return Carried(sample);
}

}  // namespace zro
