#pragma once
#include <string>

#include "rig/report/history.h"

namespace zrobench {

/// What the report's script draws, as one line of JSON that may stand inside a <script> element
/// (no '<' in it). Offsets in mdps, rates in dps, temperatures in degC, times in s; null = gap.
/// Long series are thinned to a few thousand rows with their extremes; entries, readings, stimuli
/// and tones are all there.
std::string PlotsJson(const History& history);

}  // namespace zrobench
