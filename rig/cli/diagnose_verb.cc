#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/clock.h"
#include "rig/cli/verbs.h"
#include "rig/diagnose/diagnosis.h"
#include "rig/diagnose/diagnosis_json.h"
#include "rig/diagnose/diagnosis_text.h"

namespace zrobench {
namespace {

constexpr int kExitUnexpected = 7;

struct DiagnoseArguments {
  std::string folder, expect;
  bool json = false, terms = false;
};

/// "named:gyro.creep", or only the outcome.
bool Meets(const diagnose::Diagnosis& diagnosis, const std::string& expect) {
  const std::size_t colon = expect.find(':');
  if (expect.substr(0, colon) != diagnose::OutcomeName(diagnosis.outcome)) return false;
  if (colon == std::string::npos) return true;
  for (const diagnose::TermFound& term : diagnosis.terms) {
    if (term.info->id == expect.substr(colon + 1)) return true;
  }
  return false;
}

int RunDiagnose(const DiagnoseArguments& arguments) {
  if (arguments.terms) {
    fmt::print("{}", diagnose::CatalogueText());
    return 0;
  }
  if (arguments.folder.empty()) {
    fmt::print(stderr, "diagnose: which case? Give a folder with station.toml and run-1.csv\n");
    return kExitInvalid;
  }
  const auto loaded = diagnose::LoadCase(arguments.folder);
  if (!loaded) {
    fmt::print(stderr, "{}\n", loaded.error().message);
    return kExitInvalid;
  }
  RealClock clock;
  const Instant began = clock.now();
  const bool watched = isatty(STDERR_FILENO) != 0;
  auto diagnosis = diagnose::Diagnose(*loaded, [&](std::string_view what) {
    if (watched) fmt::print(stderr, "{:6.1f} s  {}\n", ToSeconds(clock.now() - began), what);
  });
  diagnosis.seconds = ToSeconds(clock.now() - began);
  if (arguments.json) {
    fmt::print("{}\n", diagnose::ToJson(diagnosis).dump(2));
  } else {
    fmt::print("{}", diagnose::ToText(diagnosis, arguments.folder));
  }
  if (!arguments.expect.empty() && !Meets(diagnosis, arguments.expect)) {
    fmt::print(stderr, "--expect {}: not met, the verdict is {}\n", arguments.expect,
               diagnose::OutcomeName(diagnosis.outcome));
    return kExitUnexpected;
  }
  return 0;
}

}  // namespace

void AddDiagnoseVerb(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<DiagnoseArguments>();
  CLI::App* verb = app.add_subcommand(
      "diagnose",
      "Example: zrobench diagnose my-case/\n\n"
      "Locates where simulation and recordings differ and names the physics that was left out.\n"
      "CASE is a folder with station.toml (its [model] is the simulation) and run-1.csv, "
      "run-2.csv,\n"
      "..., each one power-on (docs/formats.md, \"Case folder\"). An unknown stays an unknown: "
      "what\n"
      "the data cannot tell apart is said, not guessed.");
  verb->add_option("case", a->folder, "folder with station.toml and run-1.csv, ...");
  verb->add_flag("--json", a->json, "one JSON object on standard output");
  verb->add_flag("--terms", a->terms, "print the catalogue of effects and end");
  verb->add_option("--expect", a->expect,
                   "exit 7 unless this is the verdict: named, named:gyro.creep, ...");
  verb->callback([a, &exit_code] { exit_code = RunDiagnose(*a); });
}

}  // namespace zrobench
