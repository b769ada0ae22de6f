#pragma once
#include <optional>

#include "rig/profile/profile.h"
#include "rig/station/toml_reader.h"

namespace zrobench {

/// Reads the one table of a [[step]] that names what it does, within the station's limits.
/// Empty when there is none that can be used (reported).
std::optional<Action> ReadAction(TableReader* step, const Station& station);

/// Reads a step's `with`: tones and moves during it.
std::vector<Stimulus> ReadStimuli(TableReader* step, const Station& station);

/// Temperatures that the plate may be sent to; the message names the station's limit.
Range SetPointRange(const Station& station);

}  // namespace zrobench
