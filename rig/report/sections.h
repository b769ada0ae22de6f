#pragma once
// The parts of report.html that need no script: each returns one HTML fragment, its texts escaped.
#include <string>

#include "rig/record/run_json.h"
#include "rig/report/coverage.h"
#include "rig/report/history.h"

namespace zrobench {

/// One row a check: verdict, deciding figure, what was asked, why it is not a pass.
std::string ChecksHtml(const RunManifest& manifest);
/// Every measurement with limits, uncertainty and the stretch of the record it stands on.
std::string MeasurementsHtml(const RunManifest& manifest, const History& history);
/// In sentences: bins without entry or reading, codes never seen, axes never refused.
std::string NotExercisedHtml(const Coverage& coverage);
/// Temperature bins x axes x codes, with the count of each.
std::string CoverageHtml(const Coverage& coverage);
/// Each refusal with the numbers behind it; those nobody provoked stand out.
std::string RefusalsHtml(const History& history);
/// Each tone with the rate it made.
std::string TonesHtml(const History& history);

/// "3 × 10 acoustic_or_vibration, 1 × 32 new"; empty where no reading came of it.
std::string DecisionsText(const History::Tone& tone);

}  // namespace zrobench
