#include "rig/cli/rehearsal.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>

#include "rig/cli/virtual_bench.h"
#include "rig/record/decision.h"
#include "rig/record/item_reader.h"

namespace zrobench {
namespace {

namespace fs = std::filesystem;

/// A refusal comes when the reading it spoiled ends: up to a reading after the stimulus.
constexpr double kEcho_s = 8;

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "zrobench-plan-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Folds the record of the rehearsal into steps and stimuli.
class Digest {
 public:
  void operator()(const ImuTime& time) { board_degc_ = time.temperature / 256.0; }
  void operator()(const EventItem& event) {
    using Kind = EventItem::Kind;
    const double at_s = static_cast<double>(event.at_us) * 1e-6;
    plan_.duration_s = at_s;
    if (event.kind == Kind::kStepBegin) {
      plan_.steps.push_back({event.text, at_s, 0, board_degc_, board_degc_, {}});
    }
    if (plan_.steps.empty()) return;
    PlannedStep& step = plan_.steps.back();
    if (event.kind == Kind::kStimulusBegin) {
      std::string what = event.text;
      if (event.a > 0) what += fmt::format(" {:g} Hz", event.a);
      if (event.b > 0) what += fmt::format(" {:.0f} dB SPL", event.b);
      step.stimuli.push_back({what, at_s, 0, board_degc_, {}});
    }
    if (event.kind == Kind::kLoad && event.a > 0) {
      const std::string what = fmt::format("{} {:g} %", event.text, event.a);
      step.stimuli.push_back({what, at_s, 0, board_degc_, {}});
    }
    const bool unloaded = event.kind == Kind::kLoad && event.a == 0;
    if (event.kind == Kind::kStimulusEnd || unloaded) EndStimulus(step, event.text, at_s);
    if (event.kind == Kind::kStepEnd || event.kind == Kind::kRunEnd) {
      if (step.lasts_s == 0) step.lasts_s = at_s - step.start_s;
      if (event.kind == Kind::kStepEnd) step.to_degc = board_degc_;
    }
  }
  void operator()(const BusFrame& frame) {
    constexpr std::uint32_t kEmcy = 0x90;
    if (frame.own != 0 || frame.id != kEmcy) return;
    Count(static_cast<zro::Code>(frame.data[3]), static_cast<double>(frame.at_us) * 1e-6);
  }
  void operator()(const TableItem& item) {
    zro::Table table;
    std::uint32_t generation = 0;
    if (!table.FromImage(item.image.data(), item.image.size(), &generation)) return;
    plan_.entries_degc.clear();
    for (int i = 0; i < table.size(); ++i) {
      if (table[i].origin != zro::Origin::kLearned) continue;
      plan_.entries_degc.push_back(table[i].temp_degc);
    }
  }
  template <typename Other>
  void operator()(const Other&) {}

  Rehearsal Take() { return std::move(plan_); }

 private:
  static void EndStimulus(PlannedStep& step, const std::string& text, double at_s) {
    for (PlannedStimulus& stimulus : step.stimuli) {
      if (stimulus.lasts_s == 0 && stimulus.text.starts_with(text)) {
        stimulus.lasts_s = at_s - stimulus.start_s;
        return;
      }
    }
  }
  /// To the stimulus that acts, or acted last.
  void Count(zro::Code code, double at_s) {
    for (auto step = plan_.steps.rbegin(); step != plan_.steps.rend(); ++step) {
      for (auto s = step->stimuli.rbegin(); s != step->stimuli.rend(); ++s) {
        const bool acts = s->lasts_s == 0 || at_s <= s->start_s + s->lasts_s + kEcho_s;
        if (acts) ++s->refusals[std::string(CodeName(code))];
        return;
      }
    }
  }

  Rehearsal plan_;
  double board_degc_ = 0;
};

}  // namespace

Result<Rehearsal> Rehearse(const Profile& profile, const Station& station) {
  const ScratchFolder scratch;
  if (scratch.path().empty()) {
    return Fail(Error::Kind::kFile, "plan: no folder can be made in " +
                                        fs::temp_directory_path().string() + " (see TMPDIR)");
  }
  constexpr std::uint64_t kSeed = 1;
  auto bench = VirtualBench::Make(station, kSeed);
  if (!bench) return tl::unexpected(bench.error());
  Instruments instruments = (*bench)->instruments();
  const StopRequest never;
  const auto outcome =
      ExecuteRun({profile, station, kSeed, scratch.path(), never, nullptr}, instruments);
  if (!outcome) return tl::unexpected(outcome.error());
  Digest digest;
  if (const auto end = ReadItems(outcome->folder / "record.ulg", digest); !end) {
    return tl::unexpected(end.error());
  }
  Rehearsal plan = digest.Take();
  plan.halted = outcome->manifest.reason;
  return plan;
}

}  // namespace zrobench
