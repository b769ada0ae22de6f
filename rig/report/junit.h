#pragma once
#include <string>
#include <vector>

#include "rig/record/run_json.h"

namespace zrobench {

/// junit.xml in the dialect that Jenkins and GitLab read: the profile is the suite, each check a
/// case, its measurements the case's properties; times are bench seconds. fail becomes <failure>,
/// rig_error <error>, inconclusive <skipped>; marginal passes with a note in <system-out>. A run
/// that did not end as planned has one more case, "run to its end", in error.
std::string JUnitXml(const RunManifest& manifest);

/// A name for each check, in order, each once: "lockstep"; where a profile asks for several of a
/// kind "rejects during tone", or what was asked in full. The same profile gives the same names.
std::vector<std::string> CaseNames(const std::vector<CheckResult>& checks);

}  // namespace zrobench
