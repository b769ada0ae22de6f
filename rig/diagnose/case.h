#pragma once
// What is diagnosed: a folder with station.toml and run-1.csv, run-2.csv, ..., each one power-on.
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "rig/record/replay/channel.h"
#include "rig/station/station.h"

namespace zrobench::diagnose {

struct CaseRun {
  std::string name;  ///< run-1
  std::vector<Row> rows;
  std::array<bool, kChannels> present{};  ///< columns that the file has
  double started_h = 0;                   ///< hours since the first run's start, 0 = not known
};

struct Case {
  Station station;
  std::vector<CaseRun> runs;  ///< by number; never empty

  bool Has(Channel channel) const;
};

/// Reads station and recordings; nothing else in the folder is looked at. Blocks on the disk.
/// kConfig with every error of the station, `file:line: ...` of a recording; kFile when something
/// is missing or unreadable.
Result<Case> LoadCase(const std::filesystem::path& folder);

}  // namespace zrobench::diagnose
