#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace zrobench {

/// Nothing that is read whole (profile, station, map, run.json) comes near it: what does is a
/// mistake, such as a recording given as a profile.
inline constexpr std::size_t kMaxTextFileBytes = 16 << 20;

/// The whole file. Blocks on the disk. kFile with path and reason: not there, not readable, a
/// folder, or larger than kMaxTextFileBytes.
Result<std::string> ReadTextFile(const std::filesystem::path& path);

}  // namespace zrobench
