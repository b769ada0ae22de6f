#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rig/cli/verbs.h"
#include "rig/record/decision.h"
#include "rig/record/replay/replay.h"
#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

struct ReplayArguments {
  std::string recording, map, factory, start_date, estimates, decisions, table;
  std::vector<double> reboot_at_s, cut_at_s;
  bool json = false;
};

std::optional<std::filesystem::path> PathOf(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
}

nlohmann::ordered_json ToJson(const ReplaySummary& summary) {
  nlohmann::ordered_json json = {
      {"schema", 1},
      {"samples", summary.samples},
      {"duration_s", summary.duration_s},
      {"gaps", summary.gaps},
      {"skipped_rows", summary.skipped_rows},
      {"sample_hz", summary.config.sample_hz},
      {"noise_density_dps_per_rthz", summary.config.gyro_noise_density_dps_per_rthz},
      {"readings", summary.errors.readings()}};
  for (const auto& [code, count] : summary.decisions) {
    json["decisions"][std::string(CodeName(code))] = count;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    json["error_before_learning"][std::string(1, "xyz"[axis])] = {
        {"corrector_rms_mdps", summary.errors.corrector_rms_mdps(axis)},
        {"corrector_max_mdps", summary.errors.corrector_max_mdps(axis)},
        {"constant_rms_mdps", summary.errors.constant_rms_mdps(axis)},
        {"constant_max_mdps", summary.errors.constant_max_mdps(axis)},
        {"line_in_hindsight_rms_mdps", summary.hindsight.rms_mdps(axis, 1)},
        {"cubic_in_hindsight_rms_mdps", summary.hindsight.rms_mdps(axis, 3)}};
  }
  json["entries"] = summary.final_table.size();
  return json;
}

void Print(const ReplaySummary& s, const std::string& recording) {
  fmt::print("{}: {} samples in {:.0f} s ({:.1f} Hz, {} gaps, {} rows skipped)\n", recording,
             s.samples, s.duration_s, s.config.sample_hz, s.gaps, s.skipped_rows);
  fmt::print("gyro noise {:.4f} dps/rtHz ({})\n\n", s.config.gyro_noise_density_dps_per_rthz,
             s.noise_from_data ? "from its first still seconds" : "default");
  fmt::print("decisions of the corrector\n");
  for (const auto& [code, count] : s.decisions) {
    fmt::print("  {:>3}  {:<24} {:>6}\n", static_cast<int>(code), CodeName(code), count);
  }
  fmt::print("\ntable learned ({} entries)\n  {:>8} {:>9} {:>9} {:>9}\n", s.final_table.size(),
             "degC", "x dps", "y dps", "z dps");
  for (int i = 0; i < s.final_table.size(); ++i) {
    const zro::Entry& e = s.final_table[i];
    fmt::print("  {:>8.2f} {:>9.4f} {:>9.4f} {:>9.4f}\n", e.temp_degc, e.zro_dps[0], e.zro_dps[1],
               e.zro_dps[2]);
  }
  fmt::print("\nerror of the estimate before each of {} readings entered the table [mdps]\n",
             s.errors.readings());
  fmt::print(
      "  axis   corrector rms / max   one constant rms / max   hindsight rms: line   cubic\n");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fmt::print("  {:<4} {:>12.1f} / {:<8.1f} {:>10.1f} / {:<12.1f} {:>15.1f} {:>7.1f}\n",
               "xyz"[axis], s.errors.corrector_rms_mdps(axis), s.errors.corrector_max_mdps(axis),
               s.errors.constant_rms_mdps(axis), s.errors.constant_max_mdps(axis),
               s.hindsight.rms_mdps(axis, 1), s.hindsight.rms_mdps(axis, 3));
  }
}

int RunReplay(const ReplayArguments& arguments) {
  ReplayOptions options;
  options.map = PathOf(arguments.map);
  options.factory = PathOf(arguments.factory);
  options.estimates = PathOf(arguments.estimates);
  options.decisions = PathOf(arguments.decisions);
  options.table = PathOf(arguments.table);
  options.reboot_at_s = arguments.reboot_at_s;
  options.cut_at_s = arguments.cut_at_s;
  if (!arguments.start_date.empty()) {
    options.start = ParseUtc(arguments.start_date);
    if (!options.start) {
      fmt::print(stderr, "--start-date {}: not a date like 2026-01-31 or 2026-01-31T12:00:00Z\n",
                 arguments.start_date);
      return kExitInvalid;
    }
  }
  const auto summary = Replay(arguments.recording, options);
  if (!summary) {
    fmt::print(stderr, "{}\n", summary.error().message);
    return kExitInvalid;
  }
  const std::size_t boots = arguments.reboot_at_s.size() + arguments.cut_at_s.size();
  if (summary->planned_boots < boots) {
    fmt::print(stderr, "note: {} of {} reboots and cuts lie outside the recording\n",
               boots - summary->planned_boots, boots);
  }
  if (arguments.json) {
    fmt::print("{}\n", ToJson(*summary).dump(2));
  } else {
    Print(*summary, arguments.recording);
  }
  return 0;
}

}  // namespace

void AddReplayVerb(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<ReplayArguments>();
  CLI::App* verb = app.add_subcommand(
      "replay",
      "Example: zrobench replay cold.csv --map profiles/imports/freeimu_mpu6050.toml\n\n"
      "Runs the corrector over recorded raw samples: what would it have learned, and how wrong "
      "was\n"
      "each estimate just before it learned better?");
  verb->add_option("recording", a->recording, "run folder, ULog or CSV")->required();
  verb->add_option("--map", a->map, "import map of a foreign CSV (TOML)");
  verb->add_option("--factory", a->factory, "factory entries: temp_degc, zro_x_dps, ...");
  verb->add_option("--start-date", a->start_date, "date of the first sample (ISO 8601)");
  verb->add_option("--reboot-at", a->reboot_at_s, "orderly reboots [s]")->delimiter(',');
  verb->add_option("--cut-at", a->cut_at_s, "power cuts [s]")->delimiter(',');
  verb->add_option("--estimates", a->estimates, "write the estimate at every sample (CSV)");
  verb->add_option("--decisions", a->decisions, "write every decision (CSV)");
  verb->add_option("--table", a->table, "write the final table (CSV)");
  verb->add_flag("--json", a->json, "print one JSON object and nothing else");
  verb->callback([a, &exit_code] { exit_code = RunReplay(*a); });
}

}  // namespace zrobench
