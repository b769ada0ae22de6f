#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rig/cli/plain_progress.h"
#include "rig/cli/signals.h"
#include "rig/cli/verbs.h"
#include "rig/profile/plan.h"
#include "rig/record/run_folder.h"
#include "rig/report/text.h"
#include "rig/run/run.h"
#include "rig/virtual/virtual_rig.h"

namespace zrobench {
namespace {

struct RunOptions {
  std::string profile = ZROBENCH_PROFILES "/quick-look.toml";
  std::string station = ZROBENCH_PROFILES "/stations/virtual.toml";
  std::string runs = "runs";
  std::string ui = "auto";
  std::uint64_t seed = 1;
  bool json = false;
};

int Invalid(const Error& error) {
  fmt::print(stderr, "{}\n", error.message);
  return kExitInvalid;
}

void PrintResult(const RunOutcome& outcome, const std::filesystem::path& report, bool json) {
  if (json) {
    auto object = nlohmann::ordered_json::parse(ToJson(outcome.manifest));
    object["folder"] = outcome.folder.string();
    fmt::print("{}\n", object.dump(2));
    return;
  }
  fmt::print("\n{}\nreport: {}\n{}\n", VerdictTable(outcome.manifest), report.string(),
             CountLine(outcome.manifest));
}

int Run(const RunOptions& options) {
  const auto station = LoadStation(options.station);
  if (!station) return Invalid(station.error());
  const auto profile = LoadProfile(options.profile, *station);
  if (!profile) return Invalid(profile.error());
  if (!station->all_virtual()) {
    return Invalid({Error::Kind::kConfig, options.station +
                                              ": this version drives the virtual rig only; every "
                                              "instrument must be \"virtual:\""});
  }
  VirtualClock clock(station->virtual_rig.epoch);
  auto rig = VirtualRig::Make(*station, options.seed, clock);
  if (!rig) return Invalid(rig.error());
  Instruments instruments{clock,          (*rig)->plate(),  (*rig)->speaker(),
                          (*rig)->bus(),  &(*rig)->power(), &(*rig)->environment(),
                          &(*rig)->hand()};
  PlainProgress progress(station->virtual_rig.epoch,
                         NominalDurationS(*profile, station->model.ambient_degc));
  const bool quiet = options.json || options.ui == "none";
  const auto outcome = ExecuteRun(
      {*profile, *station, options.seed, options.runs, CatchSignals(), quiet ? nullptr : &progress},
      instruments);
  if (!outcome) {
    fmt::print(stderr, "{}\n", outcome.error().message);
    return kExitRigError;
  }
  const auto report = outcome->folder / "report.txt";
  if (auto ok = WriteFileAtomically(report, FullReport(outcome->manifest)); !ok) {
    fmt::print(stderr, "{}\n", ok.error().message);
    return kExitRigError;
  }
  PrintResult(*outcome, report, options.json);
  return *outcome->manifest.exit_code;
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
