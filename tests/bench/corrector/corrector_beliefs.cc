// corrector_beliefs: what is believed, and when. A settled corrector meets a change of a size, with
// gyro noise of a ratio to its floor, in every still (one a minute) of a duration. Corruption that
// ends by then is falsely accepted this often; a genuine shift, falsely rejected in the rest.
//   corrector_beliefs [--seeds 20]
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <map>

#include "tests/bench/corrector/score.h"

namespace zrobench::bench {
namespace {

constexpr int kFromMinute = 8;
constexpr int kMinutes = 36;

Scenario Change(double size_dps, double noise_ratio) {
  Scenario s;
  s.name = "change";
  s.mean_degc = 25.0;
  s.swing_degc = 1.0;
  s.duration_s = 60.0 * (kFromMinute + kMinutes);
  s.disturbances = {{0, 1, 1, kFromMinute, 1 << 20, {size_dps, 0, 0}, noise_ratio}};
  return s;
}

/// The minute at which output and table took the change over; 0: never.
struct Belief final : Watcher {
  explicit Belief(double size_dps) : size_dps_(size_dps) {}
  void OnSample(const Instant& now, const Vector& estimate_dps) override {
    const bool follows = estimate_dps[0] - now.truth_dps[0] > 0.5 * size_dps_;
    if (now.disturbed && follows && output == 0) output = now.period - kFromMinute + 1;
  }
  void OnEvent(const Instant& now, const zro::Event& event) override {
    if (now.disturbed && zro::IsWrite(event.code) && table == 0)
      table = now.period - kFromMinute + 1;
  }
  int output = 0, table = 0;

 private:
  double size_dps_;
};

int Percent(const std::map<int, int>& at_minute, int until, int runs) {
  int count = 0;
  for (const auto& [minute, n] : at_minute) count += minute > 0 && minute <= until ? n : 0;
  return (200 * count + runs) / (2 * runs);
}

void PrintRow(double size_dps, double noise_ratio, int seeds) {
  std::map<int, int> output, table;
  for (int seed = 1; seed <= seeds; ++seed) {
    Belief belief(size_dps);
    Run(Change(size_dps, noise_ratio), LearnerKind::kOurs, static_cast<std::uint64_t>(seed),
        &belief);
    ++output[belief.output];
    ++table[belief.table];
  }
  fmt::print("| {:5.0f} | {:.2f} |", 1e3 * size_dps, noise_ratio);
  for (const int minute : {1, 2, 3, 5, 15}) fmt::print(" {:3} |", Percent(output, minute, seeds));
  for (const int minute : {1, 5, 15, 30, 35}) fmt::print(" {:3} |", Percent(table, minute, seeds));
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace zrobench::bench

int main(int argc, char** argv) {
  CLI::App app{
      "corrector_beliefs --seeds 20\nWhat is believed, after how long, in percent of runs"};
  int seeds = 20;
  app.add_option("--seeds", seeds, "runs a row")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  fmt::print(
      "| size [mdps] | noise / floor | output follows within 1 min | 2 | 3 | 5 | 15 |"
      " table within 1 min | 5 | 15 | 30 | 35 "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double size_dps : {0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 1.0}) {
    for (const double noise_ratio : {1.0, 1.1, 1.2, 1.35, 1.5}) {
      zrobench::bench::PrintRow(size_dps, noise_ratio, seeds);
    }
  }
  return 0;
}
