#pragma once
// One run from profile to verdict: folder, record, sequence, checks, run.json.
#include <filesystem>
#include <string>

#include "core/result.h"
#include "drivers/link/can_bus.h"
#include "rig/profile/profile.h"
#include "rig/record/run_json.h"
#include "rig/run/bench.h"
#include "rig/run/halt.h"
#include "rig/run/run_log.h"
#include "rig/station/station.h"

namespace zrobench {

/// The opened instruments of a station.
struct Instruments : Apparatus {
  CanBus& bus;  ///< borrowed; the board is at its other end
};

struct RunRequest {
  const Profile& profile;
  const Station& station;
  std::uint64_t seed = 0;
  std::filesystem::path runs = "runs";  ///< where the run folder goes
  const StopRequest& stop;
  RunObserver* observer = nullptr;  ///< may be null
};

struct RunOutcome {
  RunManifest manifest;  ///< as written to run.json
  std::filesystem::path folder;
  std::vector<std::string> alarms;  ///< of the record: what the rig complained about, in order
};

/// Blocks for the whole run (in the instruments' clock). The bench is safe when it returns. An
/// Error means that no run took place (folder or record could not be made); everything else,
/// a fault of the rig included, is an outcome.
Result<RunOutcome> ExecuteRun(const RunRequest& request, Instruments& instruments);

/// Judges a record by its profile: what ExecuteRun does after the last step.
std::vector<CheckResult> JudgeRecord(const std::filesystem::path& record, const Profile& profile,
                                     const Station& station);

/// Exit code of a verdict (design: the first that applies).
int ExitCode(const std::vector<CheckResult>& checks, const Flow& flow, int signal);

}  // namespace zrobench
