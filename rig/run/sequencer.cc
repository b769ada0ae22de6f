#include "rig/run/sequencer.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "rig/run/evidence.h"
#include "rig/run/steps.h"

namespace zrobench {
namespace {

constexpr double kAliveTimeout_s = 5;
constexpr int kStartTries = 3;
constexpr std::uint8_t kTableAtStart = 0, kTableAtEnd = 3;  ///< TableItem::when

Flow FromStatus(const Status& status) {
  if (status) return {};
  return Stop(Halt::Why::kRigFault, status.error().message);
}

/// A bug must not leave the bench hot or loud: it becomes a reason to halt like any other.
template <typename Part>
Flow Guarded(Part part) {
  try {
    return part();
  } catch (const std::exception& bug) {
    return Stop(Halt::Why::kInternal, bug.what());
  }
}

/// What a bench that could not be made safe does to how the run ended.
Flow Unsafe(Flow flow, const std::string& why) {
  const std::string text = "the bench could not be made safe: " + why;
  if (flow || flow.error().why == Halt::Why::kInterrupted) {
    return Stop(Halt::Why::kRigFault, text);
  }
  flow.error().text += "; " + text;
  return flow;
}

/// Boots the board afresh and dates it: from here on every input of the corrector is on record.
Flow Reboot(BenchLoop& loop) {
  const std::uint32_t boots = loop.bench().board.status().boots_seen;
  if (auto flow = FromStatus(loop.bench().board.Reset()); !flow) return flow;
  const Instant give_up = loop.now() + FromSeconds(kAliveTimeout_s);
  loop.ExpectBoot(true);
  while (loop.bench().board.status().boots_seen == boots) {
    if (loop.now() > give_up) {
      return Stop(Halt::Why::kRigFault, "the board does not answer a reset");
    }
    if (auto flow = loop.Tick(); !flow) return flow;
  }
  loop.ExpectBoot(false);
  return FromStatus(loop.bench().board.SendDate(loop.bench().clock.utc()));
}

}  // namespace

Flow Sequencer::Execute() {
  Flow flow = Guarded([this] {
    Flow begun = Begin();
    return begun ? RunSteps() : begun;
  });
  // MakeSafe mutes once more: a stimulus that could not be ended here is no reason by itself.
  static_cast<void>(Guarded([this] { return FromStatus(loop_.stimuli().Abort()); }));
  const Flow safe = Guarded([this] { return FromStatus(MakeSafe(loop_.bench())); });
  if (flow && safe) flow = Guarded([this] { return End(); });
  if (!safe) flow = Unsafe(std::move(flow), safe.error().text);
  const Flow closed = Guarded([&] {
    WriteEnd(flow);
    return Flow{};
  });
  return flow ? closed : flow;
}

void Sequencer::WriteEnd(const Flow& flow) {
  if (!flow && flow.error().why != Halt::Why::kInterrupted) loop_.log().Alarm(flow.error().text);
  loop_.log().WriteEvent(
      {.kind = EventItem::Kind::kRunEnd, .text = flow ? "completed" : flow.error().text});
}

Flow Sequencer::Begin() {
  loop_.log().WriteEvent({.kind = EventItem::Kind::kRunStart,
                          .a = static_cast<double>(profile_.steps.size()),
                          .text = profile_.name});
  // Safe state first, rehearsed before the first stimulus.
  if (auto flow = FromStatus(MakeSafe(loop_.bench())); !flow) return flow;
  const Instant give_up = loop_.now() + FromSeconds(kAliveTimeout_s);
  loop_.ExpectBoot(true);  // making safe gives the board its supply
  do {                     // one tick at least: plate and air are read before anything moves
    if (loop_.now() > give_up) {
      return Stop(Halt::Why::kRigFault,
                  "no frame from the board: check its supply and the CAN bus");
    }
    if (auto flow = loop_.Tick(); !flow) return flow;
  } while (!loop_.bench().board.status().alive);
  loop_.ExpectBoot(false);
  Flow known = KnowTheStart();
  return known ? FindLoad() : known;
}

Flow Sequencer::FindLoad() {
  const auto loads = [](const Step& step) {
    return std::holds_alternative<Load>(step.action) ||
           std::any_of(step.with.begin(), step.with.end(), [](const Stimulus& stimulus) {
             return std::holds_alternative<Load>(stimulus.what);
           });
  };
  if (std::none_of(profile_.steps.begin(), profile_.steps.end(), loads)) return {};
  const Status none = loop_.bench().board.SetLoad(0, loop_.now() + FromSeconds(kAliveTimeout_s));
  if (none || none.error().kind != Error::Kind::kRefused) return FromStatus(none);
  return Stop(Halt::Why::kUnfit, "this board cannot load itself (" + none.error().message + ")");
}

Flow Sequencer::KnowTheStart() {
  // What the board holds now may not be what it boots with: merges may wait in its RAM. Only a
  // table that outlived a boot is recorded as the start.
  std::vector<std::uint8_t> before;
  for (int i = 0; i < kStartTries; ++i) {
    const auto table = loop_.PeekTable();
    if (!table) return Stop(Halt::Why::kRigFault, table.error().message);
    if (i > 0 && table->image == before) {
      loop_.Record(kTableAtStart, *table);
      return {};
    }
    before = table->image;
    if (auto flow = Reboot(loop_); !flow) return flow;
  }
  loop_.log().Alarm(std::string(kInputsLost) + "the board's table changed at every reboot");
  return {};
}

Flow Sequencer::RunSteps() {
  for (const Step& step : profile_.steps) {
    const int index = static_cast<int>(&step - profile_.steps.data());
    loop_.log().set_step(index);
    loop_.log().WriteEvent(
        {.kind = EventItem::Kind::kStepBegin, .text = DescribeStep(step.action)});
    loop_.stimuli().Schedule(step.with);
    Flow flow = std::visit([&](const auto& action) { return RunStep(loop_, action); }, step.action);
    if (flow) flow = FinishStimuli();
    if (!flow) return flow;
    loop_.log().WriteEvent({.kind = EventItem::Kind::kStepEnd});
    ++steps_completed_;
  }
  loop_.log().set_step(-1);
  return {};
}

Flow Sequencer::FinishStimuli() {
  while (loop_.stimuli().playing()) {
    if (auto flow = loop_.Tick(); !flow) return flow;
  }
  if (const int waiting = loop_.stimuli().waiting(); waiting > 0) {
    loop_.log().Alarm(
        fmt::format("{} of this step's stimuli never began: the step was over first", waiting));
  }
  return {};
}

Flow Sequencer::End() {
  if (auto flow = loop_.ReadDecisions(); !flow) return flow;
  return loop_.ReadTable(kTableAtEnd);
}

}  // namespace zrobench
