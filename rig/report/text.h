#pragma once
#include <string>
#include <vector>

#include "rig/record/run_json.h"

namespace zrobench {

/// The verdict as a table for people: one line a check with the figure that decided, the reason
/// where it is not a pass, the rig's alarms, then the overall verdict. At most 100 columns; ends in
/// a newline.
std::string VerdictTable(const RunManifest& manifest, const std::vector<std::string>& alarms = {});

/// The same with every measurement, its limits and its uncertainty: report.txt.
std::string FullReport(const RunManifest& manifest, const std::vector<std::string>& alarms = {});

/// "7 passed, 0 failed, 0 skipped".
std::string CountLine(const RunManifest& manifest);

}  // namespace zrobench
