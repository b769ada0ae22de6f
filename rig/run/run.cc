#include "rig/run/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <exception>
#include <utility>
#include <vector>

#include "drivers/imu/can_imu_board.h"
#include "rig/record/recorder.h"
#include "rig/record/run_folder.h"
#include "rig/run/bus_tap.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"
#include "rig/run/sequencer.h"

namespace zrobench {
namespace {

std::string HostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

RunManifest StartManifest(const RunRequest& request, const Clock& clock) {
  RunManifest manifest;
  manifest.profile = request.profile.name;
  manifest.station = request.station.name;
  manifest.backend = request.station.all_virtual() ? "virtual" : "hardware";
  manifest.version = ZROBENCH_VERSION;
  manifest.build = ZROBENCH_BUILD;
  manifest.seed = request.seed;
  manifest.started = clock.utc();
  manifest.host = HostName();
  return manifest;
}

Recorder::Info RecordInfo(const RunRequest& request) {
  return {{"sys_name", "zrobench"},
          {"profile", request.profile.name},
          {"station", request.station.name},
          {"seed", std::to_string(request.seed)}};
}

/// The sequence itself, with the record open.
Flow Drive(const RunRequest& request, Instruments& instruments, Recorder& recorder) {
  RunLog log(recorder, instruments.clock, request.observer);
  BusTap tap(log);
  CanImuBoard board(instruments.bus, instruments.clock, &tap);
  Bench bench{instruments, board};
  BenchLoop loop(bench, request.station, log, request.stop);
  const Flow flow = Sequencer(request.profile, loop).Execute();
  tap.Finish();
  return flow;
}

/// What a halted run did not show cannot be held against the device.
void ExcuseTheDevice(const Halt& halt, std::vector<CheckResult>& checks) {
  const bool rig = halt.why == Halt::Why::kRigFault;
  const char* const how = rig                             ? "rig fault: "
                          : halt.why == Halt::Why::kUnfit ? "skipped: "
                                                          : "the run ended early: ";
  for (CheckResult& check : checks) {
    check.verdict = rig ? Verdict::kRigError : Verdict::kInconclusive;
    check.reason = how + halt.text;
  }
}

/// What a record without its end shows nobody can hold against the device.
void ExcuseUnfinished(std::vector<CheckResult>& checks) {
  for (CheckResult& check : checks) {
    check.verdict = Verdict::kInconclusive;
    check.reason = "the record does not hold the run's end";
  }
}

/// Intervals of a record that jumps back in time mean nothing: whatever was measured over them.
void BlameTheClock(std::uint64_t at_us, std::vector<CheckResult>& checks) {
  for (CheckResult& check : checks) {
    check.verdict = Verdict::kRigError;
    check.reason = fmt::format("time goes backwards in the record after {:.6f} s",
                               static_cast<double>(at_us) * 1e-6);
  }
}

std::vector<CheckResult> JudgeEvidence(const Result<Evidence>& evidence,
                                       const std::filesystem::path& record, const Profile& profile,
                                       const Station& station) {
  std::vector<CheckResult> checks;
  for (const Expectation& expect : profile.expects) {
    if (evidence) {
      checks.push_back(RunCheck(expect, {*evidence, station, record}));
    } else {
      checks.push_back({.check = expect.check,
                        .about = {},
                        .verdict = Verdict::kRigError,
                        .reason = evidence.error().message,
                        .measurements = {}});
    }
  }
  if (evidence && !evidence->completed) ExcuseUnfinished(checks);
  if (evidence && evidence->time_back_us != 0) BlameTheClock(evidence->time_back_us, checks);
  return checks;
}

/// Judging must not lose the run: a bug there is one more way to end.
Flow JudgeInto(const RunRequest& request, const std::filesystem::path& record, Flow flow,
               RunOutcome& outcome) {
  try {
    const auto evidence = GatherEvidence(record);
    if (evidence) outcome.alarms = evidence->alarms;
    outcome.manifest.checks = JudgeEvidence(evidence, record, request.profile, request.station);
  } catch (const std::exception& bug) {
    if (flow) flow = Stop(Halt::Why::kInternal, bug.what());
  }
  if (!flow) ExcuseTheDevice(flow.error(), outcome.manifest.checks);
  return flow;
}

Verdict Overall(const std::vector<CheckResult>& checks) {
  std::vector<Verdict> verdicts;
  for (const CheckResult& check : checks) verdicts.push_back(check.verdict);
  return Worst(verdicts);
}

}  // namespace

std::vector<CheckResult> JudgeRecord(const std::filesystem::path& record, const Profile& profile,
                                     const Station& station) {
  return JudgeEvidence(GatherEvidence(record), record, profile, station);
}

int ExitCode(const std::vector<CheckResult>& checks, const Flow& flow, int signal) {
  if (!flow && flow.error().why == Halt::Why::kInterrupted) return signal != 0 ? 128 + signal : 130;
  if (!flow && flow.error().why == Halt::Why::kInternal) return 70;
  if (!flow && flow.error().why == Halt::Why::kSafetyTrip) return 6;
  if (!flow && flow.error().why == Halt::Why::kUnfit) return 4;
  if (!flow) return 3;
  const Verdict verdict = Overall(checks);
  if (verdict == Verdict::kRigError) return 3;
  if (verdict == Verdict::kFail) return 1;
  return verdict == Verdict::kInconclusive ? 4 : 0;
}

namespace {

void Conclude(const Flow& flow, int signal, RunManifest& manifest) {
  if (!flow) manifest.reason = flow.error().text;
  manifest.exit_code = ExitCode(manifest.checks, flow, signal);
  const bool rig = manifest.exit_code == 3;  // also where no check is there to say so
  manifest.verdict = rig ? Verdict::kRigError : Overall(manifest.checks);
}

}  // namespace

Result<RunOutcome> ExecuteRun(const RunRequest& request, Instruments& instruments) {
  const RealClock real;
  auto folder = RunFolder::Create(request.runs, instruments.clock.utc(), request.station.name,
                                  request.profile.name);
  if (!folder) return tl::unexpected(folder.error());
  RunManifest manifest = StartManifest(request, instruments.clock);
  if (auto ok = folder->WriteInputs(request.profile.text, request.station.text); !ok) {
    return tl::unexpected(ok.error());
  }
  if (auto ok = folder->WriteManifest(manifest); !ok) return tl::unexpected(ok.error());
  const auto start_us =
      static_cast<std::uint64_t>(instruments.clock.now().time_since_epoch().count() / 1000);
  auto recorder = Recorder::Create(folder->record_path(), start_us, RecordInfo(request));
  if (!recorder) return tl::unexpected(recorder.error());

  Flow flow = Drive(request, instruments, **recorder);
  if (const Status closed = (*recorder)->Close(); !closed && flow) {
    flow = Stop(Halt::Why::kRigFault, closed.error().message);
  }
  RunOutcome outcome{std::move(manifest), folder->path(), {}};
  flow = JudgeInto(request, folder->record_path(), std::move(flow), outcome);
  outcome.manifest.ended = instruments.clock.utc();
  outcome.manifest.real_s = SecondsOf(real.now());
  Conclude(flow, request.stop.signal.load(), outcome.manifest);
  if (const Status kept = folder->WriteManifest(outcome.manifest); !kept && flow) {
    flow = Stop(Halt::Why::kRigFault, kept.error().message);
    ExcuseTheDevice(flow.error(), outcome.manifest.checks);
    Conclude(flow, 0, outcome.manifest);
  }
  return outcome;
}

}  // namespace zrobench
