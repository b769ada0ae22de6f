#pragma once
// run.json: what was run, how it was judged, and on which evidence (docs/run-json.schema.json).
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "rig/record/verdict.h"

namespace zrobench {

struct RunManifest {
  static constexpr int kSchema = 1;
  std::string profile, station;     ///< names
  std::string backend = "virtual";  ///< "virtual" | "hardware"
  std::string version;              ///< of the software
  std::uint64_t seed = 0;
  UtcNs started = 0;
  std::optional<UtcNs> ended;      ///< absent while the run is going on, or after it was killed
  std::optional<Verdict> verdict;  ///< likewise
  std::optional<int> exit_code;    ///< likewise
  std::string reason;              ///< why it ended early; empty for a run to its end
  std::vector<CheckResult> checks;
  std::string operator_name, lot, board_serial;  ///< when given
  std::string host, build;                       ///< what the record must not hold
  double real_s = 0;                             ///< real time the run took
};

/// Marginal counts as passed; inconclusive and rig_error as skipped.
struct CheckCounts {
  int passed = 0, failed = 0, skipped = 0;
};
CheckCounts CountChecks(const std::vector<CheckResult>& checks);

/// "pass", "marginal", "inconclusive", "fail", "rig_error".
std::string_view VerdictName(Verdict verdict);
std::optional<Verdict> VerdictNamed(std::string_view name);

/// Indented, keys in a fixed order, ends in a newline. Infinite limits are null.
std::string ToJson(const RunManifest& manifest);
/// kFile when it is no run.json of this schema; says which key. Unknown keys are ignored.
Result<RunManifest> ManifestFromJson(const std::string& text);

}  // namespace zrobench
