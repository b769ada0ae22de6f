#pragma once
// One reading: temperature and gyro averaged over the same samples (fig. 4: 38, 40).
#include <cstdint>

#include "corrector/types.h"

namespace zro {

/// The averages of a full window and what is needed to judge whether raw values were stable.
struct Summary {
  float temp_degc;
  float zro_dps[kAxes];
  float std_dps[kAxes];    ///< standard deviation of a single sample
  float sigma_dps;         ///< 1 sigma of zro_dps, worst axis; flicker included
  float slope_degc_per_s;  ///< between the halves of the window
  float temp_spread_degc;  ///< greatest minus least raw temperature
  float drift_dps[kAxes];  ///< second half's mean minus the first's
  std::uint32_t samples;   ///< averaged
  std::uint32_t lost;      ///< missing, overrun or without meaning within the window
  std::uint32_t clipped;
  std::uint32_t bad_temperatures;
};

/// Accumulates a window of `target` samples, then waits kGuardS more before the reading is ripe:
/// should motion set in meanwhile, its beginning may already be in the window, so it is dropped.
class Reading {
 public:
  static constexpr float kGuardS = 0.25f;

  explicit Reading(float sample_hz);

  void Restart(std::uint32_t target);
  void Stop() { target_ = 0; }
  bool gathering() const { return target_ > 0; }
  /// `temp_degc`: stands in for the sample's own, which is physical when `temp_valid`.
  void Add(const Sample& sample, float temp_degc, bool temp_valid);

  bool ripe() const { return target_ > 0 && n_ >= target_ && guard_ >= guard_samples_; }
  std::uint32_t gathered() const { return n_; }
  std::uint32_t target() const { return target_; }
  Summary Summarise() const;

 private:
  void Note(const Sample& sample, bool temp_valid);
  void Average(const Sample& sample, float temp_degc, bool temp_valid);

  float sample_hz_;
  std::uint32_t guard_samples_;
  std::uint32_t target_ = 0;
  std::uint32_t n_ = 0;
  std::uint32_t guard_ = 0;
  std::uint32_t temperatures_ = 0;
  std::uint32_t lost_ = 0;
  std::uint32_t clipped_ = 0;
  std::uint32_t bad_temperatures_ = 0;
  float mean_dps_[kAxes] = {};
  float squares_[kAxes] = {};
  float half_dps_[kAxes] = {};
  float mean_degc_ = 0.0f;
  float half_degc_ = 0.0f;
  float least_degc_ = 0.0f;
  float most_degc_ = 0.0f;
  std::uint32_t half_n_ = 0;
};

}  // namespace zro
