#include "rig/record/replay/replay_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "rig/record/run_folder.h"
#include "rig/record/ulog.h"

namespace zrobench {
namespace {

/// Slower rows are means or spot checks: stillness cannot be seen in them.
constexpr double kMinSampleHz = 5;

bool IsUlog(const std::filesystem::path& path) {
  std::array<char, ulog::kMagic.size() - 1> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::equal(start.begin(), start.end(), ulog::kMagic.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

}  // namespace

Result<std::unique_ptr<ReplayInput>> OpenReplayInput(
    const std::filesystem::path& recording, const std::optional<std::filesystem::path>& map) {
  std::error_code error;
  if (std::filesystem::is_directory(recording, error)) {
    const auto folder = RunFolder::Open(recording);
    if (!folder) return Fail(Error::Kind::kConfig, folder.error().message);
    return OpenRecordInput(folder->record_path());
  }
  // A recording is read several times over: a pipe cannot be.
  if (std::filesystem::exists(recording, error) &&
      !std::filesystem::is_regular_file(recording, error)) {
    return Fail(Error::Kind::kConfig, recording.string() + ": is neither a file nor a run folder");
  }
  return IsUlog(recording) ? OpenRecordInput(recording) : OpenCsvInput(recording, map);
}

double MedianStep(std::vector<double> steps_s) {
  if (steps_s.empty()) return 0;
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  return *middle;
}

Result<double> SampleRate(const std::filesystem::path& recording, std::vector<double> steps_s) {
  const double step_s = MedianStep(std::move(steps_s));
  if (step_s <= 0) {
    return Fail(Error::Kind::kConfig,
                fmt::format("{}: the sample rate cannot be told: {}", recording.string(),
                            "too few samples, or their times do not advance"));
  }
  if (1 / step_s < kMinSampleHz) {
    return Fail(Error::Kind::kConfig,
                fmt::format("{}: rows {:.3g} s apart are no raw samples; stillness needs at least "
                            "{} of them a second",
                            recording.string(), step_s, kMinSampleHz));
  }
  return 1 / step_s;
}

}  // namespace zrobench
