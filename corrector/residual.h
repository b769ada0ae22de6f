#pragma once
// What the latest accepted reading said beyond the table.
#include <cstdint>

#include "corrector/reading.h"
#include "corrector/table.h"
#include "corrector/types.h"

namespace zro {

/// Hysteresis, thermal lag and a coarse temperature sensor make the offset of this quarter of an
/// hour differ from the table's at the same temperature. The difference that the latest accepted
/// reading showed is added to the interpolated offset, fading over kFadeS and kFadeDegc. Never
/// stored, never part of the sanity check.
class Residual {
 public:
  static constexpr float kFadeS = 900.0f;
  static constexpr float kFadeDegc = 5.0f;

  explicit Residual(float sample_hz) : fade_samples_(kFadeS * sample_hz) {}

  /// `prior`: what was to be subtracted at the reading's temperature before it, and how sure that
  /// was; `table_dps`: the table's offset there, the reading already in it.
  void Take(const Summary& reading, const Estimate& prior, const float table_dps[kAxes],
            std::uint32_t sample);
  void Clear() { held_ = false; }
  /// Forgets it once faded, so that it cannot come back when the sample index wraps.
  void Expire(std::uint32_t sample);

  /// Adds it to the table's offset, dps.
  void AddTo(float zro_dps[kAxes], float temp_degc, std::uint32_t sample) const;

 private:
  float fade_samples_;
  float difference_dps_[kAxes] = {};
  float temp_degc_ = 0.0f;
  std::uint32_t sample_ = 0;
  bool held_ = false;
};

}  // namespace zro
