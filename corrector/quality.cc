#include "corrector/quality.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

// Beyond this multiple of max_vibration_ratio it is no disturbed rest any more: the device moves in
// a way the accelerometer does not see, or the gyro is broken (code 2 instead of 10).
constexpr float kGrossNoise = 2.0f;
// Faster than any package can warm: the sensor jumped.
constexpr float kMaxSpreadDegc = 5.0f;
constexpr float kColdestDegc = -60.0f;
constexpr float kHottestDegc = 150.0f;
// Six sigma of the difference of two half-window means: sqrt(2) * sqrt(2/n) * 6.
constexpr float kDriftSigmas = 12.0f;

Finding Found(Code code, float value, float limit, std::uint8_t axis = kNoAxis) {
  return {code, axis, value, limit};
}

Finding AssessTemperature(const Summary& r, const Limits& limits) {
  if (r.bad_temperatures > 0) {
    return Found(Code::kTemperatureSensor, static_cast<float>(r.bad_temperatures), 0.0f);
  }
  if (r.temp_spread_degc > kMaxSpreadDegc) {
    return Found(Code::kTemperatureSensor, r.temp_spread_degc, kMaxSpreadDegc);
  }
  if (r.temp_degc < limits.min_temp_degc) {
    return Found(Code::kTemperatureRange, r.temp_degc, limits.min_temp_degc);
  }
  if (r.temp_degc > limits.max_temp_degc) {
    return Found(Code::kTemperatureRange, r.temp_degc, limits.max_temp_degc);
  }
  if (fabsf(r.slope_degc_per_s) > limits.max_slope_degc_per_s) {
    return Found(Code::kTemperatureSlope, fabsf(r.slope_degc_per_s), limits.max_slope_degc_per_s);
  }
  return {};
}

Finding AssessNoise(const Summary& r, const Limits& limits, const NoiseFloor& floor) {
  Worst ratio{0.0f, kNoAxis};
  for (int axis = 0; axis < kAxes; ++axis) {
    const float present = floor.Ratio(r.std_dps[axis], axis);
    if (present > ratio.value) ratio = {present, static_cast<std::uint8_t>(axis)};
  }
  const float gross = kGrossNoise * limits.max_vibration_ratio;
  if (ratio.value > gross) return Found(Code::kGyroVariance, ratio.value, gross, ratio.axis);
  if (ratio.value > limits.max_vibration_ratio) {
    return Found(Code::kAcousticOrVibration, ratio.value, limits.max_vibration_ratio, ratio.axis);
  }
  constexpr float kNoDrift[kAxes] = {};
  const Worst drift = WorstDifference(r.drift_dps, kNoDrift);
  const float noise = r.std_dps[drift.axis] / sqrtf(static_cast<float>(r.samples));
  const float limit = limits.max_step_dps + kDriftSigmas * noise;
  if (drift.value > limit) return Found(Code::kGyroVariance, drift.value, limit, drift.axis);
  return {};
}

}  // namespace

bool IsPhysicalTemperature(float temp_degc) {
  return temp_degc >= kColdestDegc && temp_degc <= kHottestDegc;
}

Finding AssessQuality(const Summary& r, const Limits& limits, const NoiseFloor& floor) {
  if (r.lost > 0) return Found(Code::kSampleGap, static_cast<float>(r.lost), 0.0f);
  if (r.clipped > 0) return Found(Code::kClipped, static_cast<float>(r.clipped), 0.0f);
  const Finding temperature = AssessTemperature(r, limits);
  if (temperature.code != Code::kNone) return temperature;
  const Finding noise = AssessNoise(r, limits, floor);
  if (noise.code != Code::kNone) return noise;
  constexpr float kZero[kAxes] = {};
  const Worst bias = WorstDifference(r.zro_dps, kZero);
  if (bias.value > limits.max_bias_dps) {
    return Found(Code::kBiasLimit, bias.value, limits.max_bias_dps, bias.axis);
  }
  return {};
}

}  // namespace zro
