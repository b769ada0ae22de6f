#pragma once
#include "rig/diagnose/diagnosis.h"
#include "rig/diagnose/leftover.h"
#include "rig/diagnose/search.h"

namespace zrobench::diagnose {

/// What one block's mean scatters by in each channel: sensor noise, white noise and flicker.
PerChannel NoiseFloor(const Problem& problem, const Noise& noise);

/// Where the missing part is larger than one standard deviation of a block: channels, stretches of
/// time, and how much of the innovations' energy it is.
void Localise(const Problem& problem, const Noise& noise, const SearchResult& search,
              const Leftover& leftover, Mismatch& mismatch);

}  // namespace zrobench::diagnose
