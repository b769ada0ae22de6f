#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "rig/cli/verbs.h"
#include "rig/report/files.h"

namespace zrobench {
namespace {

using Json = nlohmann::ordered_json;

struct ReportOptions {
  std::string run;
  bool json = false;
};

void PrintJson(const Json& object) {
  fmt::print("{}\n", object.dump(2, ' ', false, Json::error_handler_t::replace));
}

int Refuse(const Error& error, int exit_code, bool json) {
  if (json) {
    PrintJson({{"schema", 1}, {"exit_code", exit_code}, {"errors", error.message}});
  } else {
    fmt::print(stderr, "{}\n", error.message);
  }
  return exit_code;
}

int Report(const ReportOptions& options) {
  const auto folder = RunFolder::Open(options.run);
  if (!folder) return Refuse(folder.error(), kExitInvalid, options.json);
  const auto manifest = folder->ReadManifest();
  if (!manifest) return Refuse(manifest.error(), kExitInvalid, options.json);
  if (const Status kept = WriteReports(*folder, *manifest); !kept) {
    return Refuse(kept.error(), kExitRigError, options.json);
  }
  const std::string html = folder->report_path().string();
  if (options.json) {
    PrintJson({{"schema", 1},
               {"exit_code", 0},
               {"html", html},
               {"text", (folder->path() / "report.txt").string()},
               {"junit", folder->junit_path().string()}});
  } else {
    fmt::print("report: {}\n", html);
  }
  return 0;
}

}  // namespace

void AddReportVerb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = app.add_subcommand(
      "report",
      "Example: zrobench report runs/2026-01-01T000000Z-virtual-quick-look\n\n"
      "Rebuilds report.html, report.txt and junit.xml from a run folder's record and run.json.");
  verb->add_option("run", options->run, "run folder")->required();
  verb->add_flag("--json", options->json, "print one JSON object and nothing else");
  verb->callback([options, &exit_code] { exit_code = Report(*options); });
}

}  // namespace zrobench
