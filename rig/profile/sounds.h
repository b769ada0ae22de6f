#pragma once
// Steps and stimuli that sound: frequencies, levels and lengths within the station's limits.
#include "core/toml_reader.h"
#include "rig/profile/profile.h"

namespace zrobench {

/// Each reports what is wrong at its place and returns what could be read.
Tone ReadTone(TableReader reader, const Station& station);
Music ReadMusic(TableReader reader, const Station& station);
Sweep ReadSweep(TableReader reader, const Station& station);

}  // namespace zrobench
