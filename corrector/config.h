#pragma once
// Thresholds in physical units. Defaults are for a consumer MEMS gyro; where a figure follows from
// a datasheet, the comment says from which.
#include <cstdint>

namespace zro {

enum class Mode : std::uint8_t { kOff = 0, kApply = 1, kLearnApply = 2, kFrozen = 3 };

/// Gates that the bench may change over the bus (object 0x2100). Same order as its sub-indices.
struct Limits {
  Mode mode = Mode::kLearnApply;
  float max_bias_dps = 12.0f;          ///< |offset| beyond this is no offset (datasheet ZRO, 3x)
  float max_step_dps = 0.05f;          ///< reading may differ this much from a close entry
  float max_slope_degc_per_s = 0.12f;  ///< temperature rate during a reading
  float still_sigma_g = 0.015f;        ///< accelerometer deviation that still counts as motionless
  std::uint16_t min_samples = 1000;    ///< averaged for one reading (at sample_hz; 5 s at 200 Hz)
  float max_vibration_ratio = 1.35f;   ///< gyro noise over its learned floor
  float min_temp_degc = -40.0f;        ///< outside: refused (code 6)
  float max_temp_degc = 85.0f;
};

struct Config {
  float sample_hz = 200.0f;
  float gyro_noise_density_dps_per_rthz = 0.005f;  ///< datasheet; first guess of the noise floor
  float bin_degc = 2.5f;                           ///< "close temperature": table granularity
  float coverage_min_degc = 0.0f;   ///< the table is complete when every bin between these ...
  float coverage_max_degc = 50.0f;  ///< ... has an entry younger than old_days
  std::uint16_t recent_days = 1;    ///< an entry younger than this is recent (fig. 5, 57)
  std::uint16_t old_days = 30;      ///< older than this: overwritten when close (fig. 5, 54 -> 59)
  std::uint8_t max_retries = 3;     ///< re-reads within one still (fig. 4)
  Limits limits;
};

/// Defaults for a sensor: windows that are seconds long whatever the rate.
inline Config ConfigFor(float sample_hz, float gyro_noise_density_dps_per_rthz) {
  Config config;
  config.sample_hz = sample_hz;
  config.gyro_noise_density_dps_per_rthz = gyro_noise_density_dps_per_rthz;
  config.limits.min_samples = static_cast<std::uint16_t>(5.0f * sample_hz);
  return config;
}

}  // namespace zro
