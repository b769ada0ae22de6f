#include "rig/cli/plain_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <variant>

#include "rig/record/decision.h"
#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

constexpr std::size_t kColumns = 100;

}  // namespace

void PlainProgress::Line(std::uint64_t at_us, const std::string& text) const {
  const std::string utc = UtcText(epoch_ + static_cast<UtcNs>(at_us) * 1000).substr(0, 19);
  const std::string line = (utc + "Z " + text).substr(0, kColumns) + '\n';
  // Nobody may be reading any more: no reason to end the run.
  static_cast<void>(std::fputs(line.c_str(), stderr));
}

std::string PlainProgress::Eta(std::uint64_t at_us) const {
  const double left_s = std::max(0.0, expected_s_ - static_cast<double>(at_us) * 1e-6);
  const int s = static_cast<int>(left_s + 0.5);
  return fmt::format("eta {:02d}:{:02d}:{:02d}", s / 3600, s / 60 % 60, s % 60);
}

void PlainProgress::OnItem(const Item& item, const RunSnapshot& snapshot) {
  if (const auto* event = std::get_if<EventItem>(&item)) OnEvent(*event, snapshot);
  if (std::holds_alternative<BusFrame>(item)) OnRejections(snapshot);
  if (std::holds_alternative<PlateItem>(item)) Heartbeat(snapshot);
}

void PlainProgress::OnEvent(const EventItem& event, const RunSnapshot& snapshot) {
  using Kind = EventItem::Kind;
  switch (event.kind) {
    case Kind::kRunStart:
      Line(event.at_us, fmt::format("run   {} {}", event.text, Eta(event.at_us)));
      break;
    case Kind::kStepBegin:
      Line(event.at_us, fmt::format("step  {}/{} {}  {}", event.step + 1, snapshot.step_count,
                                    event.text, Eta(event.at_us)));
      break;
    case Kind::kSettled:
      Line(event.at_us, fmt::format("soak  settled at {:g} degC", event.a));
      break;
    case Kind::kStimulusBegin:
      Line(event.at_us,
           event.a > 0 ? fmt::format("{}  {:g} Hz, {:.0f} dB SPL, board at {:.1f} degC", event.text,
                                     event.a, event.b, snapshot.imu_degc)
           : event.b > 0 ? fmt::format("{}, {:.0f} dB SPL, board at {:.1f} degC", event.text,
                                       event.b, snapshot.imu_degc)
                         : fmt::format("{}  board at {:.1f} degC", event.text, snapshot.imu_degc));
      break;
    case Kind::kLoad:
      Line(event.at_us,
           fmt::format("load  {:g} %, board at {:.1f} degC", event.a, snapshot.imu_degc));
      break;
    case Kind::kStimulusEnd:
      Line(event.at_us, event.text + "  over");
      break;
    case Kind::kPower:
      Line(event.at_us, event.a > 0 ? "power on" : "power off");
      break;
    case Kind::kAlarm:
      Line(event.at_us, "ALARM " + event.text);
      break;
    case Kind::kNote:
      Line(event.at_us, "note  " + event.text);
      break;
    case Kind::kRunEnd:
      Line(event.at_us, "end   " + event.text);
      break;
    case Kind::kStepEnd:
      break;
  }
}

void PlainProgress::OnRejections(const RunSnapshot& snapshot) {
  const std::uint32_t total = snapshot.expected_rejections + snapshot.unexpected_rejections;
  if (total == rejections_shown_ || snapshot.rejections.empty()) return;
  rejections_shown_ = total;
  const RejectionNote& last = snapshot.rejections.back();
  Line(last.at_us,
       fmt::format("refused {} at {:.1f} degC, {} ({:+.3f} dps on {})", CodeName(last.code),
                   last.imu_degc, last.expected ? "expected" : "UNEXPECTED", last.measured_dps,
                   last.axis < 3 ? std::string(1, "xyz"[last.axis]) : "no axis"));
}

void PlainProgress::Heartbeat(const RunSnapshot& snapshot) {
  if (real_.now() < next_beat_) return;
  next_beat_ = real_.now() + std::chrono::seconds(30);
  Line(snapshot.at_us,
       fmt::format("beat  {}/{} plate={:.1f} imu={:.1f} entries={} lost={} {}", snapshot.step + 1,
                   snapshot.step_count, snapshot.plate_degc, snapshot.imu_degc,
                   snapshot.table.size(), snapshot.lost, Eta(snapshot.at_us)));
}

}  // namespace zrobench
