#include "rig/report/files.h"

#include "rig/report/history.h"
#include "rig/report/html.h"
#include "rig/report/junit.h"
#include "rig/report/text.h"

namespace zrobench {

Status WriteReports(const RunFolder& folder, const RunManifest& manifest) {
  const auto history = ReadHistory(folder.record_path());
  if (!history) return tl::unexpected(history.error());
  std::vector<std::string> alarms;
  for (const History::Alarm& alarm : history->alarms) alarms.push_back(alarm.text);
  const auto write = [&](const std::filesystem::path& path, const std::string& text) {
    return WriteFileAtomically(path, text);
  };
  return write(folder.path() / "report.txt", FullReport(manifest, alarms))
      .and_then([&] { return write(folder.junit_path(), JUnitXml(manifest)); })
      .and_then([&] { return write(folder.report_path(), HtmlReport(manifest, *history)); });
}

}  // namespace zrobench
