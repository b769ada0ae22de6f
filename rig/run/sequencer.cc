#include "rig/run/sequencer.h"

#include <fmt/format.h>

#include "rig/run/steps.h"

namespace zrobench {
namespace {

constexpr double kAliveTimeout_s = 5;
constexpr int kStartTries = 3;

Flow FromStatus(const Status& status) {
  if (status) return {};
  return Stop(Halt::Why::kRigFault, status.error().message);
}

/// Boots the board afresh and dates it: from here on every input of the corrector is on record.
Flow Reboot(BenchLoop& loop) {
  const std::uint32_t boots = loop.bench().board.status().boots_seen;
  if (auto flow = FromStatus(loop.bench().board.Reset()); !flow) return flow;
  const Instant give_up = loop.now() + FromSeconds(kAliveTimeout_s);
  while (loop.bench().board.status().boots_seen == boots) {
    if (loop.now() > give_up) {
      return Stop(Halt::Why::kRigFault, "the board does not answer a reset");
    }
    if (auto flow = loop.Tick(); !flow) return flow;
  }
  return FromStatus(loop.bench().board.SendDate(loop.bench().clock.utc()));
}

}  // namespace

Flow Sequencer::Execute() {
  Flow flow = Begin();
  if (flow) flow = RunSteps();
  const Status quiet = loop_.stimuli().Abort();
  const Status safe = MakeSafe(loop_.bench());
  for (const Status& status : {quiet, safe}) {
    if (!status) loop_.log().Alarm("making the bench safe: " + status.error().message);
  }
  if (flow) flow = End();
  if (!flow && flow.error().why != Halt::Why::kInterrupted) loop_.log().Alarm(flow.error().text);
  loop_.log().WriteEvent(
      {.kind = EventItem::Kind::kRunEnd, .text = flow ? "completed" : flow.error().text});
  return flow;
}

Flow Sequencer::Begin() {
  loop_.log().WriteEvent({.kind = EventItem::Kind::kRunStart,
                          .a = static_cast<double>(profile_.steps.size()),
                          .text = profile_.name});
  // Safe state first, rehearsed before the first stimulus.
  if (auto flow = FromStatus(MakeSafe(loop_.bench())); !flow) return flow;
  const Instant give_up = loop_.now() + FromSeconds(kAliveTimeout_s);
  while (!loop_.bench().board.status().alive) {
    if (loop_.now() > give_up) {
      return Stop(Halt::Why::kRigFault,
                  "no frame from the board: check its supply and the CAN bus");
    }
    if (auto flow = loop_.Tick(); !flow) return flow;
  }
  // The table that the board boots with must be known: read, reboot, and read again.
  std::vector<std::uint8_t> before;
  for (int i = 0; i < kStartTries; ++i) {
    const auto table = loop_.ReadTable(0);
    if (!table) return Stop(Halt::Why::kRigFault, table.error().message);
    if (i > 0 && table->image == before) return {};
    before = table->image;
    if (auto flow = Reboot(loop_); !flow) return flow;
  }
  loop_.log().Note("the board's table changed at every reboot: its start is not known");
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
        fmt::format("{} stimulus of this step never began: its temperature was not "
                    "passed",
                    waiting));
  }
  return {};
}

Flow Sequencer::End() {
  if (auto flow = loop_.ReadDecisions(); !flow) return flow;
  const auto table = loop_.ReadTable(3);
  return table ? Flow{} : Stop(Halt::Why::kRigFault, table.error().message);
}

}  // namespace zrobench
