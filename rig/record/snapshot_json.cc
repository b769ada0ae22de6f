#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rig/record/snapshot.h"

namespace nlohmann {

/// The canonical image in hex: exact, and checked when it is read back.
template <>
struct adl_serializer<zro::Table> {
  static void to_json(json& j, const zro::Table& table) {
    std::uint8_t image[zro::Table::kMaxImageBytes];
    const std::size_t bytes = table.ToImage(0, image);
    std::string hex;
    for (std::size_t i = 0; i < bytes; ++i) hex += fmt::format("{:02x}", image[i]);
    j = std::move(hex);
  }
  static void from_json(const json& j, zro::Table& table) {
    const auto hex = j.get<std::string>();
    std::vector<std::uint8_t> image;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
      image.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
    }
    std::uint32_t generation = 0;
    if (!table.FromImage(image.data(), image.size(), &generation)) {
      throw std::invalid_argument("table is no canonical image");
    }
  }
};

}  // namespace nlohmann

namespace zrobench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(RejectionNote, at_us, code, imu_degc, measured_dps,
                                                axis, expected)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(AlarmNote, at_us, text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(
    RunSnapshot, profile, step, step_count, step_text, at_us, step_began_us, ended, end_text,
    setpoint_degc, plate_degc, drive_pct, ambient_degc, plate_seen, tone_hz, tone_v, tone_spl_db,
    tone_band_hz, load_pct, powered, stimuli, stimulus_ended_us, stimulus_seen, alarms, alarm_count,
    samples, lost, imu_hz, imu_degc, imu_degc_seen, raw_dps, rate_dps, correction_dps, still,
    learning, vibration, boots, table, table_generation, table_crc32, table_seen, rejections,
    expected_rejections, unexpected_rejections, decisions, damaged_log_records, rate_from_us,
    rate_samples, last_seq, seq_known)

namespace {

/// JSON has no NaN; it is written as null.
void NullsToNan(nlohmann::json& j) {
  if (j.is_null()) j = std::numeric_limits<double>::quiet_NaN();
  if (j.is_structured()) {
    for (auto& element : j) NullsToNan(element);
  }
}

}  // namespace

std::string ToJson(const RunSnapshot& snapshot) {
  nlohmann::json j = snapshot;
  j["schema"] = 1;
  // Texts come from files and instruments: never trust them to be UTF-8.
  return j.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<RunSnapshot> SnapshotFromJson(const std::string& text) {
  try {
    auto j = nlohmann::json::parse(text);
    if (j.at("schema") != 1) return Fail(Error::Kind::kFile, "snapshot of an unknown schema");
    NullsToNan(j);
    return j.get<RunSnapshot>();
  } catch (const std::exception& error) {
    return Fail(Error::Kind::kFile, fmt::format("snapshot: {}", error.what()));
  }
}

}  // namespace zrobench
