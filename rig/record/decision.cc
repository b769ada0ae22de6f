#include "rig/record/decision.h"

#include <cstring>

#include "corrector/node/crc16.h"

namespace zrobench {
namespace {

template <typename T>
T Get(std::span<const std::uint8_t, 24> bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

}  // namespace

std::optional<Decision> ParseDecision(std::span<const std::uint8_t, 24> bytes) {
  if (zro::node::Crc16(bytes.data(), 22) != Get<std::uint16_t>(bytes, 22)) return std::nullopt;
  Decision decision;
  decision.seq = Get<std::uint32_t>(bytes, 0);
  decision.device_us = Get<std::uint32_t>(bytes, 4);
  decision.temp_degc = Get<std::int16_t>(bytes, 8) / 256.0;
  decision.code = static_cast<zro::Code>(bytes[10]);
  decision.axis = bytes[11] >> 6;
  decision.bin = bytes[11] & 63;
  for (std::size_t i = 0; i < 3; ++i) {
    decision.measured_dps[i] = Get<std::int16_t>(bytes, 12 + 2 * i) / 256.0;
  }
  decision.limit = Get<std::uint16_t>(bytes, 18) / 256.0;
  decision.value = Get<std::uint16_t>(bytes, 20) / 256.0;
  return decision;
}

std::string_view CodeName(zro::Code code) {
  switch (code) {
    case zro::Code::kNone:
      return "none";
    case zro::Code::kMotion:
      return "motion";
    case zro::Code::kGyroVariance:
      return "gyro_variance";
    case zro::Code::kBiasLimit:
      return "bias_limit";
    case zro::Code::kDiffersFromEntry:
      return "differs_from_entry";
    case zro::Code::kTemperatureSlope:
      return "temperature_slope";
    case zro::Code::kTemperatureRange:
      return "temperature_range";
    case zro::Code::kTemperatureSensor:
      return "temperature_sensor";
    case zro::Code::kTooShort:
      return "too_short";
    case zro::Code::kClipped:
      return "clipped";
    case zro::Code::kAcousticOrVibration:
      return "acoustic_or_vibration";
    case zro::Code::kSampleGap:
      return "sample_gap";
    case zro::Code::kSupply:
      return "supply";
    case zro::Code::kStoreInvalid:
      return "store_invalid";
    case zro::Code::kStoreWrite:
      return "store_write";
    case zro::Code::kDiffersFromEstimate:
      return "differs_from_estimate";
    case zro::Code::kTestMode:
      return "test_mode";
    case zro::Code::kNew:
      return "new";
    case zro::Code::kMerged:
      return "merged";
    case zro::Code::kOverwroteOld:
      return "overwrote_old";
    case zro::Code::kRecentNothingToDo:
      return "recent_nothing_to_do";
    case zro::Code::kQuarantined:
      return "quarantined";
    case zro::Code::kShiftConfirmed:
      return "shift_confirmed";
    case zro::Code::kQuarantineExpired:
      return "quarantine_expired";
    case zro::Code::kRetry:
      return "retry";
    case zro::Code::kTableComplete:
      return "table_complete";
    case zro::Code::kReArmed:
      return "re_armed";
  }
  return "unknown";
}

}  // namespace zrobench
