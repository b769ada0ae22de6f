#pragma once
// Steps and stimuli that sound: frequencies, levels and lengths within the station's limits.
#include "core/toml_reader.h"
#include "rig/profile/profile.h"

namespace zrobench {

/// Each reports what is wrong at its place and returns what could be read.
Tone ReadTone(TableReader reader, const Station& station);
Music ReadMusic(TableReader reader, const Station& station);
Sweep ReadSweep(TableReader reader, const Station& station);

/// Durations that a bench can keep: a tick of its controller to seven days.
Range DurationRange();
/// "max_spl_db of station bench.toml".
std::string LimitOf(const Station& station, std::string_view key);
/// A range whose ends say whose limit they are.
Range Limited(double low, double high, const std::string& low_reason,
              const std::string& high_reason);

}  // namespace zrobench
