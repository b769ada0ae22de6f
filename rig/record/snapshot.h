#pragma once
// The state of a run as a pure function of its items: live screen, `watch`, replay and the look at
// a killed run all fold the same record with the same code.
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "corrector/table.h"
#include "corrector/types.h"
#include "rig/record/item.h"

namespace zrobench {

/// A live rejection (EMCY) of the board.
struct RejectionNote {
  std::uint64_t at_us = 0;
  zro::Code code = zro::Code::kNone;
  double imu_degc = 0;      ///< last temperature before it
  double measured_dps = 0;  ///< of the worst axis
  std::uint8_t axis = zro::kNoAxis;
  /// A stimulus was open, or had ended within kStimulusEchoUs: the profile provoked it.
  bool expected = false;
};

struct AlarmNote {
  std::uint64_t at_us = 0;
  std::string text;
};

struct RunSnapshot {
  /// A reading that a stimulus spoiled may be refused only when it ends: some 5 s later.
  static constexpr std::uint64_t kStimulusEchoUs = 10'000'000;
  static constexpr std::size_t kKeptRejections = 16;

  std::string profile;
  int step = -1, step_count = 0;  ///< step counts from 0
  std::string step_text;
  std::uint64_t at_us = 0;  ///< of the newest item
  std::uint64_t step_began_us = 0;
  bool ended = false;
  std::string end_text;

  // rig
  double setpoint_degc = 0, plate_degc = 0, drive_pct = 0, ambient_degc = 0;
  bool plate_seen = false;
  double tone_hz = 0, tone_v = 0, tone_spl_db = 0, tone_band_hz = 0;
  double load_pct = 0;  ///< how hard the board works to warm itself
  bool powered = true;
  std::vector<std::string> stimuli;  ///< open now
  std::uint64_t stimulus_ended_us = 0;
  bool stimulus_seen = false;
  std::deque<AlarmNote> alarms;  ///< the last kKeptRejections
  std::uint32_t alarm_count = 0;

  // board
  std::uint64_t samples = 0;
  std::uint64_t lost = 0;  ///< missing sequence numbers
  double imu_hz = 0;       ///< over the last full second
  double imu_degc = 0;
  bool imu_degc_seen = false;
  std::array<double, 3> raw_dps{}, rate_dps{};  ///< last second's means
  std::array<double, 3> correction_dps{};
  bool still = false, learning = false, vibration = false;
  std::uint32_t boots = 0;  ///< boot-up messages
  zro::Table table{};
  std::uint32_t table_generation = 0, table_crc32 = 0;
  bool table_seen = false;
  std::deque<RejectionNote> rejections;  ///< the last kKeptRejections, live
  std::uint32_t expected_rejections = 0, unexpected_rejections = 0;
  std::map<zro::Code, std::uint32_t> decisions;  ///< by code, from the board's log
  std::uint32_t damaged_log_records = 0;

  // the reducer's own
  std::uint64_t rate_from_us = 0;
  std::uint32_t rate_samples = 0;
  std::uint8_t last_seq = 0;
  bool seq_known = false;
};

/// Folds one item in. Pure; a few nanoseconds for an ImuSample.
inline void Reduce(RunSnapshot& s, const ImuSample& item) {
  s.at_us = item.at_us;
  ++s.samples;
  if (s.seq_known) s.lost += static_cast<std::uint8_t>(item.seq - s.last_seq - 1);
  s.seq_known = true;
  s.last_seq = item.seq;
  s.still = item.rate_flags & 0x04;
  s.learning = item.rate_flags & 0x10;
  s.vibration = item.rate_flags & 0x20;
  if (s.rate_samples++ == 0) s.rate_from_us = item.at_us;
  if (const std::uint64_t past_us = item.at_us - s.rate_from_us; past_us >= 1'000'000) {
    s.imu_hz = (s.rate_samples - 1) * 1e6 / static_cast<double>(past_us);
    s.rate_samples = 1;
    s.rate_from_us = item.at_us;
  }
}
void Reduce(RunSnapshot& s, const ImuTime& item);
void Reduce(RunSnapshot& s, const ImuCorrection& item);
void Reduce(RunSnapshot& s, const BusFrame& item);
void Reduce(RunSnapshot& s, const PlateItem& item);
void Reduce(RunSnapshot& s, const SpeakerItem& item);
void Reduce(RunSnapshot& s, const MeanItem& item);
void Reduce(RunSnapshot& s, const TableItem& item);
void Reduce(RunSnapshot& s, const LogItem& item);
void Reduce(RunSnapshot& s, const EventItem& item);
/// Starts from the stored state when nothing was folded before; else changes nothing.
void Reduce(RunSnapshot& s, const SnapshotItem& item);
void Reduce(RunSnapshot& s, const Item& item);

/// The whole state as one line of JSON, and back (kFile: which key is wrong).
std::string ToJson(const RunSnapshot& snapshot);
Result<RunSnapshot> SnapshotFromJson(const std::string& json);

}  // namespace zrobench
