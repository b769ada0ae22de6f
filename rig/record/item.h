#pragma once
// What a record holds, as plain data: the writer packs these, the reader gives them back, the
// reducer and the checks fold them. `at` is clock time (ULog timestamp, microseconds).
#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "corrector/types.h"

namespace zrobench {

/// DUT_RAW, DUT_ACC and DUT_RATE of one sample: the bus's integers.
struct ImuSample {
  std::uint64_t at_us = 0;
  std::array<std::int16_t, 3> raw{};
  std::array<std::int16_t, 3> accel{};
  std::array<std::int16_t, 3> rate{};  ///< corrected, LSB 1/256 dps
  std::uint8_t seq = 0;
  std::uint8_t raw_flags = 0;    ///< range code | overrun << 4, as on the bus
  std::uint8_t accel_flags = 0;  ///< clipped
  std::uint8_t rate_flags = 0;   ///< DUT_RATE byte 7
};
/// DUT_TIME: valid from the next ImuSample on.
struct ImuTime {
  std::uint64_t at_us = 0;
  std::uint32_t device_us = 0;
  std::uint16_t counter = 0;
  std::int16_t temperature = 0;  ///< LSB 1/256 degC
};
/// DUT_CORR: the correction that is being applied.
struct ImuCorrection {
  std::uint64_t at_us = 0;
  std::array<std::int16_t, 3> zro{};  ///< LSB 1/1024 dps
  std::uint8_t bin = zro::kNoBin, state = 0, age = 0;
};
/// Every other frame, raw, in bus order.
struct BusFrame {
  std::uint64_t at_us = 0;
  std::uint32_t id = 0;
  std::uint8_t dlc = 0;
  std::uint8_t own = 0;  ///< 1 = sent by the rig
  std::array<std::uint8_t, 8> data{};
};
struct PlateItem {
  std::uint64_t at_us = 0;
  double setpoint_degc = 0, process_degc = 0, drive_pct = 0, ambient_degc = 0;
};
struct SpeakerItem {
  std::uint64_t at_us = 0;
  double hz = 0, v = 0, spl_db = 0;
  double band_hz = 0;  ///< 0 = a sine; else noise of that width about hz
};
/// Means over the second that ends at `at_us`, in units.
struct MeanItem {
  std::uint64_t at_us = 0;
  float imu_degc = 0;
  std::array<float, 3> raw_dps{}, rate_dps{}, accel_g{};
  std::uint32_t samples = 0;
};
/// The board's table at a moment (canonical image).
struct TableItem {
  std::uint64_t at_us = 0;
  std::uint8_t when = 0;  ///< 0 start, 1 before power cycle, 2 after boot, 3 end
  std::uint32_t crc32 = 0;
  std::vector<std::uint8_t> image;
};
/// One record of the board's decision log, its 24 bytes as read (object 0x2201).
struct LogItem {
  std::uint64_t at_us = 0;
  std::array<std::uint8_t, 24> bytes{};
};
/// Something that began, ended or happened.
struct EventItem {
  enum class Kind : std::uint8_t {
    kRunStart = 0,   ///< text = profile name, a = number of steps
    kStepBegin = 1,  ///< step = index, text = "ramp to 45 degc"
    kStepEnd = 2,
    kStimulusBegin = 3,  ///< text = "tone" | "music 24000-34000 Hz" | "sweep ..." |
                         ///< "move hand_held", a = hz (of a tone), b = spl_db
    kStimulusEnd = 4,
    kPower = 5,  ///< a = 0 off, 1 on
    kSettled = 6,
    kAlarm = 7,  ///< the rig is at fault; text says what
    kNote = 8,
    kRunEnd = 9,  ///< text = why
    kLoad = 10,   ///< the board warms itself from here on, a = duty_pct; 0 = no more
  };
  std::uint64_t at_us = 0;
  Kind kind = Kind::kNote;
  std::int32_t step = -1;
  double a = 0, b = 0;
  std::string text = {};  ///< at most 95 bytes are kept
};
/// The reduced state (rig/record/snapshot.h) as JSON, about one a minute: a late reader may begin
/// here instead of at the start.
struct SnapshotItem {
  std::uint64_t at_us = 0;
  std::string json;  ///< at most 60000 bytes
};

using Item = std::variant<ImuSample, ImuTime, ImuCorrection, BusFrame, PlateItem, SpeakerItem,
                          MeanItem, TableItem, LogItem, EventItem, SnapshotItem>;

}  // namespace zrobench
