#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace zrobench {

/// The canonical columns of recordings (docs/formats.md), in this order.
enum class Channel : std::uint8_t {
  kTime,
  kSetpoint,
  kPlate,
  kDrive,
  kAmbient,
  kImuTemperature,
  kGyroX,
  kGyroY,
  kGyroZ,
  kAccelX,
  kAccelY,
  kAccelZ,
  kSupply,
  kToneHz,
  kToneV,
  kToneSpl,
  kImuTime,
  kSeq,
};
inline constexpr std::array<std::string_view, 18> kChannelNames = {
    "t_s",        "setpoint_degc", "plate_degc", "drive_pct",   "ambient_degc", "imu_degc",
    "gyro_x_dps", "gyro_y_dps",    "gyro_z_dps", "accel_x_g",   "accel_y_g",    "accel_z_g",
    "supply_v",   "tone_hz",       "tone_v",     "tone_spl_db", "imu_time_us",  "seq"};
inline constexpr std::size_t kChannels = kChannelNames.size();

constexpr std::size_t Index(Channel channel) { return static_cast<std::size_t>(channel); }
constexpr std::optional<Channel> ChannelNamed(std::string_view name) {
  for (std::size_t i = 0; i < kChannels; ++i) {
    if (kChannelNames[i] == name) return static_cast<Channel>(i);
  }
  return std::nullopt;
}

/// One row of a recording: canonical units, NaN where the channel was not sampled.
struct Row {
  std::array<double, kChannels> values;
  Row() { values.fill(std::numeric_limits<double>::quiet_NaN()); }
  double operator[](Channel channel) const { return values[Index(channel)]; }
  double& operator[](Channel channel) { return values[Index(channel)]; }
};

}  // namespace zrobench
