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
    evidence_.last_us = s.at_us;
    if (last_seq_) {
      evidence_.samples_lost += static_cast<std::uint8_t>(s.seq - *last_seq_ - 1);
    }
    last_seq_ = s.seq;
  }
  void operator()(const ImuTime& t) {
    // Device time runs from the boot: the first pair after a boot ties it to ours.
    if (!boot_us_) boot_us_ = t.at_us - t.device_us;
  }
  void operator()(const BusFrame& f) {
    zro::node::Frame frame{f.id, f.dlc, {}};
    std::copy_n(f.data.begin(), 8, frame.data);
    if (zro::node::HeartbeatMsg beat; !f.own && Decode(frame, &beat) &&
                                      beat.id == zro::node::HeartbeatMsg::kNodeId &&
                                      beat.state == zro::node::kStateBootUp) {
      OnBoot();
    }
    if (zro::node::StatusMsg status; Decode(frame, &status)) nv_state_ = status.nv_state;
  }
  void operator()(const LogItem& item) {
    const auto record = ParseDecision(item.bytes);
    if (!record) return;
    if (last_log_seq_ && record->seq > *last_log_seq_ + 1) {
      evidence_.decisions_lost += record->seq - *last_log_seq_ - 1;
    }
    last_log_seq_ = record->seq;
    evidence_.decisions.push_back(
        {boot_us_.value_or(item.at_us - record->device_us) + record->device_us, *record});
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
  void OnBoot() {
    last_seq_.reset();
    boot_us_.reset();
    last_log_seq_.reset();
  }
  void Open(const EventItem& e, std::string kind) {
    evidence_.stimuli.push_back({e.at_us, 0, std::move(kind)});
  }
  void CloseLast(const EventItem& e) {
    if (!evidence_.stimuli.empty()) evidence_.stimuli.back().last_us = e.at_us;
  }
  void OnEvent(const EventItem& e) {
    using Kind = EventItem::Kind;
    if (e.kind == Kind::kStimulusBegin) Open(e, e.text);
    if (e.kind == Kind::kStimulusEnd) CloseLast(e);
    if (e.kind == Kind::kPower && e.a == 0) {
      Open(e, "off");
      evidence_.nv_clean_before_cut = evidence_.nv_clean_before_cut && nv_state_ == kNvClean;
    }
    if (e.kind == Kind::kPower && e.a != 0) CloseLast(e);
    if (e.kind == Kind::kAlarm) evidence_.alarms.push_back(e.text);
    if (e.kind == Kind::kAlarm && e.text.starts_with("frames lost")) ++evidence_.inputs_incomplete;
    if (e.kind == Kind::kRunEnd) evidence_.completed = e.text == "completed";
  }

  Evidence evidence_;
  std::optional<std::uint8_t> last_seq_;
  std::optional<std::uint64_t> boot_us_;
  std::optional<std::uint32_t> last_log_seq_;
  std::uint8_t nv_state_ = kNvClean;
};

}  // namespace

Result<Evidence> GatherEvidence(const std::filesystem::path& record) {
  Gatherer gatherer;
  if (const auto end = ReadItems(record, gatherer); !end) return tl::unexpected(end.error());
  return gatherer.Finish();
}

}  // namespace zrobench
