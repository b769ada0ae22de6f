#include "rig/record/replay/noise_survey.h"

#include <algorithm>
#include <cmath>

namespace zrobench {
namespace {

constexpr double kWindowS = 5, kGiveUpS = 600;
/// Coarse words can stand still: no sensor is quieter than this.
constexpr double kLeastDensity = 2e-4;

/// Standard deviation of `value(sample)` over the window.
template <typename Value>
double Deviation(const std::vector<zro::Sample>& window, Value value) {
  double mean = 0, squares = 0;
  for (const zro::Sample& sample : window) mean += double{value(sample)};
  mean /= static_cast<double>(window.size());
  for (const zro::Sample& sample : window) squares += std::pow(double{value(sample)} - mean, 2);
  return std::sqrt(squares / static_cast<double>(window.size()));
}

}  // namespace

NoiseSurvey::NoiseSurvey(double sample_hz, float still_sigma_g)
    : sample_hz_(sample_hz),
      still_sigma_g_(still_sigma_g),
      wanted_(static_cast<std::size_t>(std::max(16.0, kWindowS * sample_hz))) {}

bool NoiseSurvey::OnSample(double t_s, const zro::Sample& sample) {
  if (!began_s_) began_s_ = t_s;
  if (t_s - *began_s_ > kGiveUpS) return false;
  if (sample.elapsed != 1 || sample.gyro_clipped || sample.accel_clipped || sample.overrun) {
    window_.clear();
  }
  window_.push_back(sample);
  if (window_.size() < wanted_) return true;
  if (Still()) {
    density_ = Density();
    return false;
  }
  window_.clear();
  return true;
}

bool NoiseSurvey::Still() const {
  for (int axis = 0; axis < zro::kAxes; ++axis) {
    const auto accel_g = [axis](const zro::Sample& s) { return s.accel_g[axis]; };
    if (Deviation(window_, accel_g) > double{still_sigma_g_}) return false;
  }
  return true;
}

float NoiseSurvey::Density() const {
  double worst_dps = 0;
  for (int axis = 0; axis < zro::kAxes; ++axis) {
    const auto rate_dps = [axis](const zro::Sample& s) { return s.rate_dps[axis]; };
    worst_dps = std::max(worst_dps, Deviation(window_, rate_dps));
  }
  return static_cast<float>(std::max(worst_dps * std::sqrt(2 / sample_hz_), kLeastDensity));
}

}  // namespace zrobench
