#include "rig/run/evidence.h"

#include <algorithm>
#include <optional>
#include <variant>

#include "corrector/node/codec.h"
#include "rig/record/decision.h"
#include "rig/record/item_reader.h"

namespace zrobench {
namespace {

constexpr std::uint64_t kSecond_us = 1'000'000;
constexpr std::uint64_t kAfterglow_us = 2 * kSecond_us;  ///< a mean this soon after is not quiet
constexpr std::uint8_t kNvClean = 0;

class Gatherer {
 public:
  void operator()(const ImuSample& s) {
    if (evidence_.samples++ == 0) evidence_.first_us = s.at_us;
    if (s.at_us < evidence_.last_us && evidence_.time_back_us == 0) {
      evidence_.time_back_us = evidence_.last_us;
    }
    evidence_.last_us = s.at_us;
    if (last_seq_) {
      evidence_.samples_lost += static_cast<std::uint8_t>(s.seq - *last_seq_ - 1);
    }
    last_seq_ = s.seq;
  }
  void operator()(const ImuTime& t) { last_time_ = t; }
  void operator()(const BusFrame& f) {
    zro::node::Frame frame{f.id, f.dlc, {}};
    std::copy_n(f.data.begin(), 8, frame.data);
    if (zro::node::HeartbeatMsg beat; !f.own && Decode(frame, &beat) &&
                                      beat.id == zro::node::HeartbeatMsg::kNodeId &&
                                      beat.state == zro::node::kStateBootUp) {
      OnBoot();
    }
    if (zro::node::StatusMsg status; Decode(frame, &status)) nv_state_ = status.nv_state;
    if (zro::node::TimeStampMsg date; Decode(frame, &date)) OnDate(f.at_us, date.days);
  }
  void operator()(const LogItem& item) {
    const auto record = ParseDecision(item.bytes);
    if (!record) {
      ++evidence_.decisions_lost;
      if (last_log_seq_) ++*last_log_seq_;
      return;
    }
    if (last_log_seq_ && record->seq > *last_log_seq_ + 1) {
      evidence_.decisions_lost += record->seq - *last_log_seq_ - 1;
    }
    last_log_seq_ = record->seq;
    evidence_.decisions.push_back({HostTime(item.at_us, record->device_us), *record});
  }
  void operator()(const MeanItem& m) { evidence_.seconds.push_back({m, false}); }
  void operator()(const TableItem& t) { evidence_.tables.push_back(t); }
  void operator()(const EventItem& e) { OnEvent(e); }
  template <typename Other>
  void operator()(const Other&) {}

  Evidence Finish() {
    for (Interval& open : evidence_.stimuli) {
      if (open.last_us == 0) open.last_us = evidence_.last_us;
    }
    for (Second& second : evidence_.seconds) {
      const std::uint64_t end = second.mean.at_us;
      second.quiet =
          std::none_of(evidence_.stimuli.begin(), evidence_.stimuli.end(), [&](const Interval& i) {
            return i.Overlaps(end - std::min(end, kSecond_us + kAfterglow_us), end);
          });
    }
    return std::move(evidence_);
  }

 private:
  void OnDate(std::uint64_t at_us, std::uint16_t days) {
    const bool jumped = evidence_.today_days != 0 && days > evidence_.today_days + 1;
    if (jumped) evidence_.date_jumps_us.push_back(at_us);
    evidence_.today_days = days;
  }
  void OnBoot() {
    last_seq_.reset();
    last_time_.reset();
    last_log_seq_.reset();
  }
  /// The newest pair of times ties the device's clock to ours, so that drift does not add up; the
  /// signed difference stands the wrap of 32 bits of microseconds (every 71.6 min).
  std::uint64_t HostTime(std::uint64_t read_at_us, std::uint32_t device_us) const {
    if (!last_time_) return read_at_us;
    const auto since = static_cast<std::int32_t>(device_us - last_time_->device_us);
    const auto at = static_cast<std::int64_t>(last_time_->at_us) + since;
    return static_cast<std::uint64_t>(std::max<std::int64_t>(at, 0));
  }
  void Open(const EventItem& e, std::string kind) {
    evidence_.stimuli.push_back({e.at_us, 0, std::move(kind)});
  }
  void Close(const EventItem& e, const std::string& kind) {
    for (Interval& open : evidence_.stimuli) {
      if (open.last_us != 0 || open.kind != kind) continue;
      open.last_us = e.at_us;
      return;
    }
  }
  void OnEvent(const EventItem& e) {
    using Kind = EventItem::Kind;
    if (e.kind == Kind::kStimulusBegin) Open(e, e.text);
    if (e.kind == Kind::kStimulusEnd) Close(e, e.text);
    if (e.kind == Kind::kPower && e.a == 0) {
      Open(e, "off");
      evidence_.cuts.push_back({e.at_us, nv_state_ == kNvClean});
    }
    if (e.kind == Kind::kPower && e.a != 0) Close(e, "off");
    if (e.kind == Kind::kAlarm) evidence_.alarms.push_back(e.text);
    if (e.kind == Kind::kAlarm && e.text.starts_with(kInputsLost)) ++evidence_.inputs_lost;
    if (e.kind == Kind::kAlarm && e.text.starts_with(kDateBackwards)) evidence_.date_back = true;
    if (e.kind == Kind::kRunEnd) evidence_.completed = e.text == "completed";
  }

  Evidence evidence_;
  std::optional<std::uint8_t> last_seq_;
  std::optional<ImuTime> last_time_;
  std::optional<std::uint32_t> last_log_seq_;
  std::uint8_t nv_state_ = kNvClean;
};

}  // namespace

std::span<const Second> SameAge(const Evidence& evidence, std::uint64_t at_us) {
  const auto& jumps = evidence.date_jumps_us;
  const auto next = std::upper_bound(jumps.begin(), jumps.end(), at_us);
  // The second in which the date moved holds both.
  const std::uint64_t from_us = next == jumps.begin() ? 0 : *(next - 1) + kSecond_us;
  const std::uint64_t to_us = next == jumps.end() ? UINT64_MAX : *next;
  const auto ends_before = [](const Second& s, std::uint64_t us) { return s.mean.at_us < us; };
  const auto& seconds = evidence.seconds;
  const auto first = std::lower_bound(seconds.begin(), seconds.end(), from_us, ends_before);
  return {first, std::lower_bound(first, seconds.end(), to_us, ends_before)};
}

Result<Evidence> GatherEvidence(const std::filesystem::path& record) {
  Gatherer gatherer;
  if (const auto end = ReadItems(record, gatherer); !end) return tl::unexpected(end.error());
  return gatherer.Finish();
}

}  // namespace zrobench
