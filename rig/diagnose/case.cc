#include "rig/diagnose/case.h"

#include <fmt/format.h>

#include <algorithm>

#include "rig/record/replay/csv_source.h"

namespace zrobench::diagnose {
namespace {

Result<CaseRun> ReadRun(const std::filesystem::path& path, const ImportMap& map) {
  auto source = CsvSource::Open(path, map);
  if (!source) return tl::unexpected(source.error());
  CaseRun run;
  run.name = path.stem().string();
  for (std::size_t i = 0; i < kChannels; ++i) {
    run.present[i] = source->has(static_cast<Channel>(i));
  }
  while (true) {
    auto row = source->Next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
    run.rows.push_back(**row);
  }
  if (run.rows.size() < 2) {
    return Fail(Error::Kind::kConfig, fmt::format("{}: fewer than two rows", path.string()));
  }
  return run;
}

Result<ImportMap> MapOf(const Station& station, const std::filesystem::path& folder) {
  if (station.recording.map.empty()) return ImportMap{};
  return LoadImportMap(folder / station.recording.map);
}

}  // namespace

bool Case::Has(Channel channel) const {
  return std::ranges::any_of(runs, [&](const CaseRun& r) { return r.present[Index(channel)]; });
}

Result<Case> LoadCase(const std::filesystem::path& folder) {
  auto station = LoadStation(folder / "station.toml");
  if (!station) return tl::unexpected(station.error());
  const auto map = MapOf(*station, folder);
  if (!map) return tl::unexpected(map.error());
  Case loaded{std::move(*station), {}};
  for (int number = 1;; ++number) {
    const std::filesystem::path path = folder / fmt::format("run-{}.csv", number);
    if (!std::filesystem::exists(path)) break;
    auto run = ReadRun(path, *map);
    if (!run) return tl::unexpected(run.error());
    const auto& started = loaded.station.recording.started_h;
    if (const auto found = started.find(run->name); found != started.end()) {
      run->started_h = found->second;
    }
    loaded.runs.push_back(std::move(*run));
  }
  if (loaded.runs.empty()) {
    return Fail(Error::Kind::kFile,
                fmt::format("{}: no run-1.csv; a case is a folder with station.toml and run-1.csv, "
                            "run-2.csv, ...",
                            folder.string()));
  }
  return loaded;
}

}  // namespace zrobench::diagnose
