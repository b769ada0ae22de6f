#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "core/clock.h"
#include "core/result.h"
#include "rig/record/run_json.h"

namespace zrobench {

/// The folder of one run. record.ulg is the truth; all else can be rebuilt. Calls block on the
/// disk.
class RunFolder {
 public:
  /// Makes `runs`/<UTC>-<station>-<profile>[-N], a name nobody has, and the parents it needs.
  /// Characters that do not belong in a file name become '-'.
  static Result<RunFolder> Create(const std::filesystem::path& runs, UtcNs epoch,
                                  std::string_view station, std::string_view profile);
  /// A folder that holds a record.ulg; kFile otherwise.
  static Result<RunFolder> Open(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path record_path() const { return path_ / "record.ulg"; }
  std::filesystem::path run_json_path() const { return path_ / "run.json"; }
  std::filesystem::path profile_path() const { return path_ / "profile.toml"; }
  std::filesystem::path station_path() const { return path_ / "station.toml"; }
  std::filesystem::path report_path() const { return path_ / "report.html"; }
  std::filesystem::path junit_path() const { return path_ / "junit.xml"; }

  /// Keeps the texts of profile and station exactly as they were read.
  Status WriteInputs(const std::string& profile_toml, const std::string& station_toml) const;
  Status WriteManifest(const RunManifest& manifest) const;
  Result<RunManifest> ReadManifest() const;

 private:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

/// Replaces the file's text so that a reader, or a power cut, finds the old one or the new one:
/// temporary file, fsync, rename.
Status WriteFileAtomically(const std::filesystem::path& path, std::string_view text);

}  // namespace zrobench
