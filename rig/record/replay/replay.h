#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "corrector/config.h"
#include "corrector/table.h"
#include "corrector/types.h"
#include "rig/record/replay/error_table.h"
#include "rig/record/replay/hindsight.h"

namespace zrobench {

/// What `zrobench replay` may be told (docs/formats.md, "Replay").
struct ReplayOptions {
  std::optional<std::filesystem::path> map;      ///< import map of a foreign CSV
  std::optional<std::filesystem::path> factory;  ///< entries in the store before the first sample
  std::optional<UtcNs> start;       ///< date of the first sample; else entries are undated
  std::vector<double> reboot_at_s;  ///< orderly: commits first; any order
  std::vector<double> cut_at_s;     ///< power cuts; times as in the recording
  std::optional<std::filesystem::path> estimates, decisions, table;  ///< CSV files to write
};

struct ReplaySummary {
  std::uint64_t samples = 0;
  double duration_s = 0;
  std::uint64_t gaps = 0;           ///< places where samples are missing
  std::uint64_t skipped_rows = 0;   ///< torn lines left out
  std::uint64_t planned_boots = 0;  ///< of the options, those that the recording reached
  zro::Config config;               ///< as used: sample rate and noise density are the data's own
  bool noise_from_data = false;     ///< else the default density
  std::map<zro::Code, std::uint64_t> decisions;
  zro::Table final_table{};
  ErrorTable errors;
  Hindsight hindsight;  ///< of the readings that entered the table
};

/// Runs the corrector over a recording: a CSV of canonical columns or with a map, a ULog of ours,
/// or a run folder (which also brings its start table, dates and boots). The corrector is
/// configured by zro::ConfigFor: sample rate = 1 / median step, a reading = 5 s of it, noise
/// density from the first 5 still seconds where they exist. A step longer than 2.5 periods is a gap
/// (or what `seq` says). kConfig when the data lack what learning needs, a boot's time is no
/// number, or a file to write is one that is read; says what.
Result<ReplaySummary> Replay(const std::filesystem::path& recording, const ReplayOptions& options);

}  // namespace zrobench
