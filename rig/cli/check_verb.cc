#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rig/cli/verbs.h"
#include "rig/profile/plan.h"
#include "rig/profile/profile.h"

namespace zrobench {
namespace {

struct CheckOptions {
  std::vector<std::string> profiles;
  std::string station = ZROBENCH_PROFILES "/stations/virtual.toml";
  bool json = false;
};

int Check(const CheckOptions& options) {
  const auto station = LoadStation(options.station);
  nlohmann::ordered_json report = {{"schema", 1}, {"station", options.station}};
  std::string errors = station ? "" : station.error().message;
  for (const std::string& path : options.profiles) {
    if (!station) break;
    const auto profile = LoadProfile(path, *station);
    const std::string message = profile ? "" : profile.error().message;
    report["profiles"].push_back(
        {{"path", path}, {"valid", profile.has_value()}, {"errors", message}});
    if (!message.empty()) errors += (errors.empty() ? "" : "\n") + message;
    if (profile && !options.json) {
      fmt::print("{}: valid, {} steps, {} checks, about {:.0f} min of bench time\n", path,
                 profile->steps.size(), profile->expects.size(),
                 NominalDurationS(*profile, station->model.ambient_degc) / 60);
    }
  }
  report["valid"] = errors.empty();
  report["errors"] = errors;
  if (options.json) {
    fmt::print("{}\n", report.dump(2));
  } else if (!errors.empty()) {
    fmt::print(stderr, "{}\n", errors);
  }
  return errors.empty() ? 0 : kExitInvalid;
}

}  // namespace

void AddCheckVerb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* verb = app.add_subcommand(
      "check",
      "Example: zrobench check profiles/quick-look.toml\n\n"
      "Validates profiles against a station; every error with file:line:column. Nothing moves.");
  verb->add_option("profiles", options->profiles, "profile files (TOML)")->required();
  verb->add_option("--station", options->station, "station file (TOML)")->capture_default_str();
  verb->add_flag("--json", options->json, "print one JSON object and nothing else");
  verb->callback([options, &exit_code] { exit_code = Check(*options); });
}

}  // namespace zrobench
