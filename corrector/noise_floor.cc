#include "corrector/noise_floor.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

constexpr float kDownGain = 0.5f;
constexpr float kUpGain = 0.0625f;
constexpr float kLeastDps = 1e-4f;  // below any part's noise: keeps the ratio finite

}  // namespace

NoiseFloor::NoiseFloor(float density_dps_per_rthz, float sample_hz) {
  const float guess = Max(density_dps_per_rthz * sqrtf(0.5f * sample_hz), kLeastDps);
  for (float& floor : floor_dps_) floor = guess;
}

void NoiseFloor::Learn(const Summary& reading) {
  for (int axis = 0; axis < kAxes; ++axis) {
    if (reading.std_dps[axis] <= 0.0f) continue;
    const float now = Max(reading.std_dps[axis], kLeastDps);
    float& floor = floor_dps_[axis];
    floor += (!learned_[axis] ? 1.0f : now < floor ? kDownGain : kUpGain) * (now - floor);
    learned_[axis] = true;
  }
}

float NoiseFloor::Ratio(float std_dps, int axis) const {
  return std_dps / (floor_dps_[axis] * (learned_[axis] ? 1.0f : kGuessTolerance));
}

bool NoiseFloor::IsExceeded(float variance_dps2, float limit, int axis) const {
  return variance_dps2 >
         Square(limit * floor_dps_[axis] * (learned_[axis] ? 1.0f : kGuessTolerance));
}

PresentNoise::PresentNoise(float sample_hz) : gain_(1.0f / (kMemoryS * sample_hz)) {}

void PresentNoise::Add(const float rate_dps[kAxes]) {
  for (int axis = 0; axis < kAxes; ++axis) {
    if (primed_) {
      const float step = rate_dps[axis] - previous_dps_[axis];
      squares_[axis] += gain_ * (0.5f * step * step - squares_[axis]);
    }
    previous_dps_[axis] = rate_dps[axis];
  }
  primed_ = true;
}

}  // namespace zro
