#pragma once
#include <string>

#include "rig/record/run_json.h"
#include "rig/report/history.h"

namespace zrobench {

/// report.html: one file that asks nobody for anything. The verdict, why, and what was not
/// exercised need no script; the plots draw what PlotsJson embeds.
std::string HtmlReport(const RunManifest& manifest, const History& history);

}  // namespace zrobench
