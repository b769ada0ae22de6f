#pragma once
#include <string>

#include "rig/record/verdict.h"

namespace zrobench {

/// "-20 .. 20", ">= 1", "<= 0", "none".
std::string LimitsText(const Measurement& measurement);

/// "3.865 +- 2.3 mdps": value, expanded uncertainty (k = 2) where it is not exact, unit.
std::string ValueText(const Measurement& measurement);

/// The measurement nearest to, or farthest beyond, its limit: what the check hung on. Null when
/// the check measured nothing. Points into `check`.
const Measurement* DecidingMeasurement(const CheckResult& check);

}  // namespace zrobench
