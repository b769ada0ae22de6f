#include "rig/record/snapshot.h"

#include <algorithm>

#include "corrector/node/codec.h"
#include "rig/record/decision.h"

namespace zrobench {
namespace {

template <typename T>
void Keep(std::deque<T>& notes, T note) {
  notes.push_back(std::move(note));
  if (notes.size() > RunSnapshot::kKeptRejections) notes.pop_front();
}

zro::node::Frame FrameOf(const BusFrame& item) {
  zro::node::Frame frame{item.id, item.dlc, {}};
  std::copy(item.data.begin(), item.data.end(), frame.data);
  return frame;
}

bool Provoked(const RunSnapshot& s, std::uint64_t at_us) {
  if (!s.stimuli.empty()) return true;
  return s.stimulus_seen && at_us - s.stimulus_ended_us <= RunSnapshot::kStimulusEchoUs;
}

void FoldEmergency(RunSnapshot& s, const BusFrame& item) {
  zro::node::EmcyMsg emcy{};
  if (!zro::node::Decode(FrameOf(item), &emcy)) return;
  const auto code = static_cast<zro::Code>(emcy.reason);
  if (!zro::IsRejection(code)) return;
  RejectionNote note{item.at_us, code, s.imu_degc, emcy.measured / 256.0, emcy.axis, false};
  note.expected = Provoked(s, item.at_us);
  ++(note.expected ? s.expected_rejections : s.unexpected_rejections);
  Keep(s.rejections, note);
}

/// A rebooted board starts counting anew: no gap.
void FoldBoot(RunSnapshot& s) {
  ++s.boots;
  s.seq_known = false;
  s.rate_samples = 0;
}

void EndStimulus(RunSnapshot& s, const EventItem& item) {
  const auto open = std::find(s.stimuli.begin(), s.stimuli.end(), item.text);
  if (open != s.stimuli.end()) s.stimuli.erase(open);
  s.stimulus_seen = true;
  s.stimulus_ended_us = item.at_us;
}

void BeginStep(RunSnapshot& s, const EventItem& item) {
  s.step = item.step;
  s.step_text = item.text;
  s.step_began_us = item.at_us;
}

}  // namespace

void Reduce(RunSnapshot& s, const ImuTime& item) {
  s.at_us = item.at_us;
  s.imu_degc = item.temperature / 256.0;
  s.imu_degc_seen = true;
}

void Reduce(RunSnapshot& s, const ImuCorrection& item) {
  s.at_us = item.at_us;
  for (std::size_t i = 0; i < 3; ++i) s.correction_dps[i] = item.zro[i] / 1024.0;
}

void Reduce(RunSnapshot& s, const BusFrame& item) {
  s.at_us = item.at_us;
  if (item.own) return;
  if (item.id == zro::node::EmcyMsg::kId) FoldEmergency(s, item);
  if (item.id == zro::node::HeartbeatMsg::kNodeId && item.data[0] == zro::node::kStateBootUp) {
    FoldBoot(s);
  }
}

void Reduce(RunSnapshot& s, const PlateItem& item) {
  s.at_us = item.at_us;
  s.setpoint_degc = item.setpoint_degc;
  s.plate_degc = item.process_degc;
  s.drive_pct = item.drive_pct;
  s.ambient_degc = item.ambient_degc;
  s.plate_seen = true;
}

void Reduce(RunSnapshot& s, const SpeakerItem& item) {
  s.at_us = item.at_us;
  s.tone_hz = item.hz;
  s.tone_v = item.v;
  s.tone_spl_db = item.spl_db;
  s.tone_band_hz = item.band_hz;
}

void Reduce(RunSnapshot& s, const MeanItem& item) {
  s.at_us = item.at_us;
  std::copy(item.raw_dps.begin(), item.raw_dps.end(), s.raw_dps.begin());
  std::copy(item.rate_dps.begin(), item.rate_dps.end(), s.rate_dps.begin());
}

void Reduce(RunSnapshot& s, const TableItem& item) {
  s.at_us = item.at_us;
  std::uint32_t generation = 0;
  if (!s.table.FromImage(item.image.data(), item.image.size(), &generation)) return;
  s.table_generation = generation;
  s.table_crc32 = item.crc32;
  s.table_seen = true;
}

void Reduce(RunSnapshot& s, const LogItem& item) {
  s.at_us = item.at_us;
  if (const auto decision = ParseDecision(item.bytes)) {
    ++s.decisions[decision->code];
  } else {
    ++s.damaged_log_records;
  }
}

void Reduce(RunSnapshot& s, const EventItem& item) {
  s.at_us = item.at_us;
  switch (item.kind) {
    case EventItem::Kind::kRunStart:
      s.profile = item.text;
      s.step_count = static_cast<int>(item.a);
      break;
    case EventItem::Kind::kStepBegin:
      BeginStep(s, item);
      break;
    case EventItem::Kind::kStimulusBegin:
      s.stimuli.push_back(item.text);
      break;
    case EventItem::Kind::kStimulusEnd:
      EndStimulus(s, item);
      break;
    case EventItem::Kind::kPower:
      s.powered = item.a != 0;
      break;
    case EventItem::Kind::kLoad:
      s.load_pct = item.a;
      break;
    case EventItem::Kind::kAlarm:
      ++s.alarm_count;
      Keep(s.alarms, AlarmNote{item.at_us, item.text});
      break;
    case EventItem::Kind::kRunEnd:
      s.ended = true;
      s.end_text = item.text;
      break;
    case EventItem::Kind::kStepEnd:
    case EventItem::Kind::kSettled:
    case EventItem::Kind::kNote:
      break;
  }
}

void Reduce(RunSnapshot& s, const SnapshotItem& item) {
  if (s.at_us != 0 || s.samples != 0) return;
  if (auto stored = SnapshotFromJson(item.json)) s = std::move(*stored);
}

void Reduce(RunSnapshot& s, const Item& item) {
  std::visit([&s](const auto& concrete) { Reduce(s, concrete); }, item);
}

}  // namespace zrobench
