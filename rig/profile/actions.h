#pragma once
#include <optional>

#include "core/toml_reader.h"
#include "rig/profile/profile.h"

namespace zrobench {

/// Reads the one table of a [[step]] that names what it does, within the station's limits.
/// Empty when there is none that can be used (reported).
std::optional<Action> ReadAction(TableReader* step, const Station& station);

/// Reads a step's `with`: tones and moves during it. `from_degc`: set point before the step, where
/// it is known: a stimulus that could never start is refused.
std::vector<Stimulus> ReadStimuli(TableReader* step, const Station& station,
                                  const std::optional<Action>& action,
                                  std::optional<double> from_degc);

/// Where a soak or a ramp goes; empty for other actions.
std::optional<double> SetPointOf(const Action& action);

}  // namespace zrobench
