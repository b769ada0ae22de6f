#include "rig/report/history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "rig/record/item_reader.h"

namespace zrobench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kAfterglow_s = 2.0;    ///< a mean this soon after a stimulus is not quiet
constexpr double kReading_s = 5.0;      ///< what the corrector averages for one decision
constexpr double kGraze_s = 0.5;        ///< a part too short to matter
constexpr double kBeforeTone_s = 10.0;  ///< what a tone's effect is measured against
constexpr std::string_view kOff = "off";

std::array<double, 3> Doubles(const std::array<float, 3>& from) {
  return {double{from[0]}, double{from[1]}, double{from[2]}};
}

class Historian {
 public:
  explicit Historian(std::uint64_t start_us) { history_.start_us = start_us; }

  void operator()(const ImuTime& item) {
    last_time_ = item;
    board_degc_ = item.temperature / 256.0;
  }
  void operator()(const BusFrame& item) {
    const std::uint32_t boots = bus_.boots;
    Reduce(bus_, item);
    if (bus_.boots != boots) last_time_.reset();  // its clock starts anew
  }
  void operator()(const PlateItem& item) {
    // Before the first step the set point is whatever somebody else left there.
    history_.plate.push_back({Seconds(item.at_us), step_begun_ ? item.setpoint_degc : kNone,
                              item.process_degc, board_degc_});
  }
  void operator()(const SpeakerItem& item) {
    const double t_s = Seconds(item.at_us);
    if (sounding_) history_.tones.back().to_s = t_s;
    const bool goes_on = sounding_ && item.band_hz > 0 && item.hz == history_.tones.back().hz &&
                         item.band_hz == history_.tones.back().band_hz;
    sounding_ = item.hz > 0;
    if (goes_on) {
      double& loudest_db = history_.tones.back().spl_db;
      loudest_db = std::max(loudest_db, item.spl_db);
    } else if (sounding_) {
      history_.tones.push_back({t_s, t_s, item.hz, item.spl_db, board_degc_, {}, item.band_hz, {}});
    }
  }
  void operator()(const MeanItem& item) {
    if (item.samples == 0) return;
    history_.seconds.push_back({Seconds(item.at_us), double{item.imu_degc}, Doubles(item.raw_dps),
                                Doubles(item.rate_dps), false});
  }
  void operator()(const TableItem& item) {
    Reduce(bus_, item);
    history_.table = bus_.table;
    history_.table_s = Seconds(item.at_us);
  }
  void operator()(const LogItem& item) {
    if (const auto decision = ParseDecision(item.bytes)) {
      history_.readings.push_back({TimeOf(decision->device_us, item.at_us), *decision, -1});
    }
  }
  void operator()(const EventItem& item) {
    using Kind = EventItem::Kind;
    const double t_s = Seconds(item.at_us);
    step_begun_ = step_begun_ || item.kind == Kind::kStepBegin;
    if (item.kind == Kind::kStimulusBegin) {
      history_.stimuli.push_back({t_s, kNone, item.text, item.a, item.b});
    } else if (item.kind == Kind::kStimulusEnd) {
      Close(item.text, t_s);
    } else if (item.kind == Kind::kPower && item.a == 0) {
      history_.stimuli.push_back({t_s, kNone, std::string(kOff), 0, 0});
      board_degc_ = kNone;
    } else if (item.kind == Kind::kPower) {
      Close(kOff, t_s);
    } else if (item.kind == Kind::kLoad) {
      SetLoad(t_s, item.a);
    } else if (item.kind == Kind::kAlarm) {
      history_.alarms.push_back({t_s, item.text});
    }
  }
  template <typename Other>
  void operator()(const Other& item) {
    Seconds(item.at_us);
  }

  History Finish(const ulog::End& end) {
    for (History::Stimulus& s : history_.stimuli) {
      if (std::isnan(s.to_s)) s.to_s = history_.duration_s;
    }
    if (sounding_) history_.tones.back().to_s = history_.duration_s;
    SetLoad(history_.duration_s, 0);
    for (History::Second& second : history_.seconds) second.quiet = IsQuiet(second.t_s);
    for (History::Reading& reading : history_.readings) {
      reading.stimulus = StimulusAt(reading.t_s);
      if (History::Tone* tone = ToneOf(reading.t_s)) ++tone->decisions[reading.decision.code];
    }
    MeasureShifts();
    if (!end.whole) history_.damage = end.message;
    return std::move(history_);
  }

 private:
  double Seconds(std::uint64_t at_us) {
    const double t_s = (static_cast<double>(at_us) - static_cast<double>(history_.start_us)) * 1e-6;
    history_.duration_s = std::max(history_.duration_s, t_s);
    return t_s;
  }
  /// The latest pair of board's and bench's time ties the two clocks; a signed difference stands
  /// the wrap of the board's 32 bits of microseconds (every 71.6 min).
  double TimeOf(std::uint32_t device_us, std::uint64_t read_at_us) {
    if (!last_time_) return Seconds(read_at_us);
    const auto since_us = static_cast<std::int32_t>(device_us - last_time_->device_us);
    return Seconds(last_time_->at_us) + since_us * 1e-6;
  }
  void Close(std::string_view kind, double t_s) {
    const auto open = std::find_if(
        history_.stimuli.begin(), history_.stimuli.end(),
        [&](const History::Stimulus& s) { return s.kind == kind && std::isnan(s.to_s); });
    if (open != history_.stimuli.end()) open->to_s = t_s;
  }
  void SetLoad(double t_s, double duty_pct) {
    if (load_pct_ > 0) history_.loads.back().to_s = t_s;
    load_pct_ = duty_pct;
    if (duty_pct > 0) history_.loads.push_back({t_s, t_s, duty_pct});
  }
  /// The sound that was the longest part of a reading judged at `t_s`; null when there was none.
  History::Tone* ToneOf(double t_s) {
    History::Tone* longest = nullptr;
    double most_s = kGraze_s;
    for (History::Tone& tone : history_.tones) {
      const double part_s = std::min(tone.to_s, t_s) - std::max(tone.from_s, t_s - kReading_s);
      if (part_s <= most_s) continue;
      most_s = part_s;
      longest = &tone;
    }
    return longest;
  }
  bool IsQuiet(double t_s) const {
    return std::none_of(history_.stimuli.begin(), history_.stimuli.end(), [&](const auto& s) {
      return s.from_s < t_s && s.to_s > t_s - 1 - kAfterglow_s;
    });
  }
  /// The latest that may have spoiled a reading judged at `t_s`.
  int StimulusAt(double t_s) const {
    constexpr double kEcho_s = RunSnapshot::kStimulusEchoUs * 1e-6;
    for (std::size_t i = history_.stimuli.size(); i-- > 0;) {
      const History::Stimulus& s = history_.stimuli[i];
      if (s.kind != kOff && s.from_s <= t_s && t_s <= s.to_s + kEcho_s) return static_cast<int>(i);
    }
    return -1;
  }
  /// Mean corrected rate of the whole seconds in a stretch, all of them or the quiet ones.
  std::array<double, 3> MeanRate(double from_s, double to_s, bool only_quiet) const {
    std::array<double, 3> sum{};
    int n = 0;
    for (const History::Second& second : history_.seconds) {
      if (second.t_s - 1 < from_s || second.t_s > to_s || (only_quiet && !second.quiet)) continue;
      for (std::size_t a = 0; a < 3; ++a) sum[a] += second.rate_dps[a];
      ++n;
    }
    for (double& s : sum) s = n > 0 ? s / n : kNone;
    return sum;
  }
  /// The tones of a sweep follow each other at once: all are measured against the silence before.
  void MeasureShifts() {
    double silent_until_s = 0, last_s = -1;
    for (History::Tone& tone : history_.tones) {
      if (tone.from_s > last_s) silent_until_s = tone.from_s;
      last_s = tone.to_s;
      const auto before = MeanRate(silent_until_s - kBeforeTone_s, silent_until_s, true);
      tone.shift_dps = MeanRate(tone.from_s, tone.to_s, false);
      for (std::size_t a = 0; a < 3; ++a) tone.shift_dps[a] -= before[a];
    }
  }

  History history_;
  RunSnapshot bus_;  ///< for boots and table images
  std::optional<ImuTime> last_time_;
  double board_degc_ = kNone;
  bool step_begun_ = false, sounding_ = false;
  double load_pct_ = 0;
};

}  // namespace

bool IsAccepted(zro::Code code) {
  switch (code) {
    case zro::Code::kNew:
    case zro::Code::kMerged:
    case zro::Code::kOverwroteOld:
    case zro::Code::kRecentNothingToDo:
    case zro::Code::kShiftConfirmed:
      return true;
    default:
      return false;
  }
}

Result<History> ReadHistory(const std::filesystem::path& record) {
  auto reader = ItemReader::Open(record);
  if (!reader) return tl::unexpected(reader.error());
  Historian historian(reader->start_us());
  reader->Drain(historian);
  return historian.Finish(reader->end());
}

}  // namespace zrobench
