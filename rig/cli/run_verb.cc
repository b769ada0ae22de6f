#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "rig/cli/plain_progress.h"
#include "rig/cli/signals.h"
#include "rig/cli/verbs.h"
#include "rig/cli/virtual_bench.h"
#include "rig/profile/plan.h"
#include "rig/report/files.h"
#include "rig/report/text.h"

namespace zrobench {
namespace {

using Json = nlohmann::ordered_json;

struct RunOptions {
  std::string profile = ZROBENCH_PROFILES "/quick-look.toml";
  std::string station = ZROBENCH_PROFILES "/stations/virtual.toml";
  std::string runs = "runs";
  std::string ui = "auto";
  std::uint64_t seed = 1;
  bool json = false;
};

/// A run that never was: with --json the reason is the object, else a line for people.
int Refuse(const Error& error, int exit_code, bool json) {
  if (json) {
    const Json object = {
        {"schema", RunManifest::kSchema}, {"exit_code", exit_code}, {"errors", error.message}};
    fmt::print("{}\n", object.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    fmt::print(stderr, "{}\n", error.message);
  }
  return exit_code;
}

/// Standard output may be closed: the exit code tells the verdict all the same.
void Print(const std::string& text) {
  static_cast<void>(std::fputs(text.c_str(), stdout));
  static_cast<void>(std::fflush(stdout));
}

void PrintResult(const RunOutcome& outcome, bool json) {
  if (json) {
    auto object = Json::parse(ToJson(outcome.manifest));
    object["folder"] = outcome.folder.string();
    object["alarms"] = outcome.alarms;
    Print(object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    return;
  }
  Print(fmt::format("\n{}\nreport: {}, as text report.txt\n{}\n",
                    VerdictTable(outcome.manifest, outcome.alarms),
                    (outcome.folder / "report.html").string(), CountLine(outcome.manifest)));
}

int Run(const RunOptions& options) {
  const auto station = LoadStation(options.station);
  if (!station) return Refuse(station.error(), kExitInvalid, options.json);
  const auto profile = LoadProfile(options.profile, *station);
  if (!profile) return Refuse(profile.error(), kExitInvalid, options.json);
  if (!station->all_virtual()) {
    return Refuse({Error::Kind::kConfig, options.station +
                                             ": this version drives the virtual rig only; every "
                                             "instrument must be \"virtual:\""},
                  kExitInvalid, options.json);
  }
  auto bench = VirtualBench::Make(*station, options.seed);
  if (!bench) return Refuse(bench.error(), kExitInvalid, options.json);
  Instruments instruments = (*bench)->instruments();
  PlainProgress progress(station->virtual_rig.epoch,
                         NominalDurationS(*profile, station->model.ambient_degc));
  const bool quiet = options.json || options.ui == "none";
  const auto outcome = ExecuteRun(
      {*profile, *station, options.seed, options.runs, CatchSignals(), quiet ? nullptr : &progress},
      instruments);
  if (!outcome) return Refuse(outcome.error(), kExitRigError, options.json);
  const auto folder = RunFolder::Open(outcome->folder);
  const Status kept =
      folder.and_then([&](const RunFolder& made) { return WriteReports(made, outcome->manifest); });
  PrintResult(*outcome, options.json);
  const int exit_code = *outcome->manifest.exit_code;
  if (kept) return exit_code;
  static_cast<void>(std::fputs((kept.error().message + '\n').c_str(), stderr));
  // The report can be rebuilt from the record: it never hides why a run was ended.
  return exit_code == 0 || exit_code == 1 || exit_code == 4 ? kExitRigError : exit_code;
}

}  // namespace

void AddRunVerb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* verb = app.add_subcommand(
      "run",
      "Example: zrobench run profiles/quick-look.toml --seed 7\n\n"
      "Drives the bench through a profile, records it, judges the corrector, writes the report.");
  verb->add_option("profile", options->profile, "profile file (TOML)")->capture_default_str();
  verb->add_option("--station", options->station, "station file (TOML)")->capture_default_str();
  verb->add_option("--seed", options->seed, "seed of the virtual rig's noise")
      ->capture_default_str();
  verb->add_option("--runs", options->runs, "folder for run folders")->capture_default_str();
  verb->add_option("--ui", options->ui, "progress: auto (plain lines), plain, none")
      ->check(CLI::IsMember({"auto", "plain", "none"}))
      ->capture_default_str();
  verb->add_flag("--json", options->json, "print one JSON object and nothing else");
  verb->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace zrobench
