#pragma once
// What this gyro's noise is when nothing disturbs it.
#include <cstdint>

#include "corrector/reading.h"
#include "corrector/types.h"

namespace zro {

/// Per-axis standard deviation of a sample at rest, learned from accepted readings. Until the
/// first, the datasheet's noise density over half the sample rate stands in for it, with
/// kGuessTolerance: parts and filter bandwidths differ from the sheet.
class NoiseFloor {
 public:
  static constexpr float kGuessTolerance = 3.0f;

  /// Density one-sided, dps/sqrt(Hz).
  NoiseFloor(float density_dps_per_rthz, float sample_hz);

  /// An accepted reading: followed quickly downwards, slowly upwards, so that a noisy surrounding
  /// cannot lift the floor by being met often. An axis that never moved is stuck, or coarser than
  /// its noise: it says nothing of the floor, which would lock out every later reading.
  void Learn(const Summary& reading);

  /// Every axis has told its floor: until then a tone may hide below kGuessTolerance.
  bool learned() const { return learned_[0] && learned_[1] && learned_[2]; }

  /// Noise of an axis over its floor; divided by kGuessTolerance while the floor is a guess.
  float Ratio(float std_dps, int axis) const;
  /// Whether that ratio is above `limit`, from the square: once a sample, without a root.
  bool IsExceeded(float variance_dps2, float limit, int axis) const;

 private:
  float floor_dps_[kAxes];
  bool learned_[kAxes] = {};
};

/// Noise of the present moment, from differences of successive samples: unlike a variance, it sees
/// neither offset nor slow change.
class PresentNoise {
 public:
  static constexpr float kMemoryS = 1.0f;

  explicit PresentNoise(float sample_hz);
  void Add(const float rate_dps[kAxes]);
  /// Variance of a sample, dps^2.
  float Variance(int axis) const { return squares_[axis]; }

 private:
  float gain_;
  float previous_dps_[kAxes] = {};
  float squares_[kAxes] = {};
  bool primed_ = false;
};

}  // namespace zro
