#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rig/cli/rehearsal.h"
#include "rig/cli/verbs.h"
#include "rig/profile/profile.h"

namespace zrobench {
namespace {

struct PlanOptions {
  std::string profile = ZROBENCH_PROFILES "/quick-look.toml";
  std::string station = ZROBENCH_PROFILES "/stations/virtual.toml";
  bool json = false;
};

std::string Clock(double s) {
  const int whole = static_cast<int>(s + 0.5);
  return fmt::format("{:d}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string Codes(const std::map<std::string, int>& refusals) {
  std::string text;
  for (const auto& [name, count] : refusals) text += fmt::format("  {} x {}", count, name);
  return text;
}

void Print(const Rehearsal& plan, const std::string& profile) {
  fmt::print("{}: {} of bench time\n\n  {:>8} {:>8} {:>14}  {}\n", profile, Clock(plan.duration_s),
             "start", "lasts", "board degC", "step");
  for (const PlannedStep& step : plan.steps) {
    fmt::print("  {:>8} {:>8} {:>6.1f} ->{:>5.1f}  {}\n", Clock(step.start_s), Clock(step.lasts_s),
               step.from_degc, step.to_degc, step.text);
    for (const PlannedStimulus& stimulus : step.stimuli) {
      fmt::print("  {:>8} {:>8} {:>14.1f}    {}{}\n", Clock(stimulus.start_s),
                 Clock(stimulus.lasts_s), stimulus.board_degc, stimulus.text,
                 Codes(stimulus.refusals));
    }
  }
  fmt::print("\nentries a working corrector would hold at the end:");
  for (const double degc : plan.entries_degc) fmt::print(" {:.1f}", degc);
  fmt::print(" degC\n");
  if (!plan.halted.empty()) fmt::print("it would not end: {}\n", plan.halted);
}

nlohmann::ordered_json ToJson(const Rehearsal& plan) {
  nlohmann::ordered_json json = {{"schema", 1},
                                 {"duration_s", plan.duration_s},
                                 {"halted", plan.halted},
                                 {"entries_degc", plan.entries_degc}};
  for (const PlannedStep& step : plan.steps) {
    nlohmann::ordered_json one = {{"text", step.text},       {"start_s", step.start_s},
                                  {"lasts_s", step.lasts_s}, {"from_degc", step.from_degc},
                                  {"to_degc", step.to_degc}, {"stimuli", nlohmann::json::array()}};
    for (const PlannedStimulus& stimulus : step.stimuli) {
      one["stimuli"].push_back({{"text", stimulus.text},
                                {"start_s", stimulus.start_s},
                                {"lasts_s", stimulus.lasts_s},
                                {"board_degc", stimulus.board_degc},
                                {"refusals", stimulus.refusals}});
    }
    json["steps"].push_back(std::move(one));
  }
  return json;
}

int Plan(const PlanOptions& options) {
  const auto fail = [](const Error& error, int exit_code) {
    fmt::print(stderr, "{}\n", error.message);
    return exit_code;
  };
  const auto station = LoadStation(options.station);
  if (!station) return fail(station.error(), kExitInvalid);
  const auto profile = LoadProfile(options.profile, *station);
  if (!profile) return fail(profile.error(), kExitInvalid);
  const auto plan = Rehearse(*profile, *station);
  if (!plan) return fail(plan.error(), kExitRigError);
  if (options.json) {
    fmt::print("{}\n", ToJson(*plan).dump(2));
  } else {
    Print(*plan, options.profile);
  }
  return 0;
}

}  // namespace

void AddPlanVerb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* verb = app.add_subcommand(
      "plan",
      "Example: zrobench plan profiles/quick-look.toml --station my-bench.toml\n\n"
      "Predicts a run without moving anything, by rehearsing it on the station's own model: when\n"
      "each step begins, which temperatures the board sees, which refusals to expect.");
  verb->add_option("profile", options->profile, "profile file (TOML)")->capture_default_str();
  verb->add_option("--station", options->station, "station file (TOML)")->capture_default_str();
  verb->add_flag("--json", options->json, "print one JSON object and nothing else");
  verb->callback([options, &exit_code] { exit_code = Plan(*options); });
}

}  // namespace zrobench
