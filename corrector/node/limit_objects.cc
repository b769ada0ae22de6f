#include "corrector/node/limit_objects.h"

#include "corrector/bytes.h"
#include "corrector/crc32.h"
#include "corrector/node/codec.h"

namespace zro::node {
namespace {

/// Also false for NaN.
bool Within(float value, float above, float most) { return value > above && value <= most; }

SdoAbort SetFloat(const std::uint8_t* bytes, float above, float most, float* limit) {
  const float value = GetFloat(bytes);
  if (!Within(value, above, most)) return SdoAbort::kRange;
  *limit = value;
  return SdoAbort::kNone;
}

SdoAbort SetMode(std::uint8_t mode, Limits* limits) {
  if (mode > static_cast<std::uint8_t>(Mode::kFrozen)) return SdoAbort::kRange;
  limits->mode = static_cast<Mode>(mode);
  return SdoAbort::kNone;
}

SdoAbort SetTemperatures(float low_degc, float high_degc, Limits* limits) {
  if (!(low_degc < high_degc)) return SdoAbort::kRange;
  limits->min_temp_degc = low_degc;
  limits->max_temp_degc = high_degc;
  return SdoAbort::kNone;
}

SdoAbort SetMinSamples(std::uint16_t samples, Limits* limits) {
  if (samples < 2) return SdoAbort::kRange;  // no variance of less
  limits->min_samples = samples;
  return SdoAbort::kNone;
}

}  // namespace

void PutLimit(const Limits& limits, std::uint8_t sub, ByteWriter* out) {
  const auto put_degc = [out](float degc) {
    out->Put(static_cast<std::uint16_t>(ToWire16(degc, kDegcPerTempLsb)), 2);
  };
  switch (sub) {
    case 1:
      return out->Put(static_cast<std::uint8_t>(limits.mode), 1);
    case 2:
      return out->PutFloat(limits.max_bias_dps);
    case 3:
      return out->PutFloat(limits.max_step_dps);
    case 4:
      return out->PutFloat(limits.max_slope_degc_per_s);
    case 5:
      return out->PutFloat(limits.still_sigma_g);
    case 6:
      return out->Put(limits.min_samples, 2);
    case 7:
      return out->PutFloat(limits.max_vibration_ratio);
    case 8:
      return put_degc(limits.min_temp_degc);
    case 9:
      return put_degc(limits.max_temp_degc);
    default:
      return;
  }
}

SdoAbort SetLimit(std::uint8_t sub, const std::uint8_t* bytes, Limits* limits) {
  switch (sub) {
    case 1:
      return SetMode(bytes[0], limits);
    case 2:
      return SetFloat(bytes, 0, 4000, &limits->max_bias_dps);  // the widest gyro range
    case 3:
      return SetFloat(bytes, 0, 4000, &limits->max_step_dps);
    case 4:
      return SetFloat(bytes, 0, 100, &limits->max_slope_degc_per_s);
    case 5:
      return SetFloat(bytes, 0, 4, &limits->still_sigma_g);  // full scale
    case 6:
      return SetMinSamples(GetU16(bytes), limits);
    case 7:
      return SetFloat(bytes, 1, 1000, &limits->max_vibration_ratio);
    case 8:
      return SetTemperatures(
          static_cast<float>(static_cast<std::int16_t>(GetU16(bytes))) * kDegcPerTempLsb,
          limits->max_temp_degc, limits);
    case 9:
      return SetTemperatures(
          limits->min_temp_degc,
          static_cast<float>(static_cast<std::int16_t>(GetU16(bytes))) * kDegcPerTempLsb, limits);
    default:
      return SdoAbort::kNoSub;
  }
}

std::uint32_t LimitsCrc(const Limits& limits) {
  std::uint8_t bytes[kLimitSubs * 4];
  ByteWriter out(bytes, sizeof bytes);
  for (std::uint8_t sub = 1; sub <= kLimitSubs; ++sub) PutLimit(limits, sub, &out);
  return Crc32(bytes, out.size());
}

}  // namespace zro::node
