#include <fmt/format.h>

#include <memory>

#include "rig/cli/verbs.h"
#include "rig/report/files.h"

namespace zrobench {
namespace {

int Complain(const Error& error, int exit_code) {
  fmt::print(stderr, "{}\n", error.message);
  return exit_code;
}

int Report(const std::string& path) {
  const auto folder = RunFolder::Open(path);
  if (!folder) return Complain(folder.error(), kExitInvalid);
  const auto manifest = folder->ReadManifest();
  if (!manifest) return Complain(manifest.error(), kExitInvalid);
  if (const Status kept = WriteReports(*folder, *manifest); !kept) {
    return Complain(kept.error(), kExitRigError);
  }
  fmt::print("report: {}\n", folder->report_path().string());
  return 0;
}

}  // namespace

void AddReportVerb(CLI::App& app, int& exit_code) {
  auto path = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand(
      "report",
      "Example: zrobench report runs/2026-01-01T000000Z-virtual-quick-look\n\n"
      "Rebuilds report.html, report.txt and junit.xml from a run folder's record and run.json.");
  verb->add_option("run", *path, "run folder")->required();
  verb->callback([path, &exit_code] { exit_code = Report(*path); });
}

}  // namespace zrobench
