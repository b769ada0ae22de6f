#pragma once
// Whose limit a number of a profile must keep: the station's, or any bench's.
#include <string>
#include <string_view>

#include "core/toml_reader.h"
#include "rig/station/station.h"

namespace zrobench {

/// "max_spl_db of station bench.toml".
std::string LimitOf(const Station& station, std::string_view key);
/// A range whose ends say whose limit they are.
Range Limited(double low, double high, const std::string& low_reason,
              const std::string& high_reason);

/// Durations that a bench can keep [s]: a tick of its controller to seven days.
Range DurationRange();
/// Temperatures that the plate may be sent to [degC]; the message names the station's limit.
Range SetPointRange(const Station& station);

}  // namespace zrobench
