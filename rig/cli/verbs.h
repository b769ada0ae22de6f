#pragma once
// One function a verb: adds its subcommand; its exit code lands in `exit_code` when it ran.
#include <CLI/CLI.hpp>

namespace zrobench {

void AddRunVerb(CLI::App& app, int& exit_code);
void AddCheckVerb(CLI::App& app, int& exit_code);
void AddPlanVerb(CLI::App& app, int& exit_code);
void AddReplayVerb(CLI::App& app, int& exit_code);
void AddDiagnoseVerb(CLI::App& app, int& exit_code);
void AddReportVerb(CLI::App& app, int& exit_code);

/// Exit codes that do not come from a verdict (all of them: README).
inline constexpr int kExitInvalid = 2, kExitRigError = 3, kExitInternal = 70;

}  // namespace zrobench
