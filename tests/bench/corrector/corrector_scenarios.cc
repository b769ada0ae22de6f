// corrector_scenarios: the corrector's error, mdps, in every scenario.
//   corrector_scenarios                        the table of docs/corrector.md (seeds 1-20)
//   corrector_scenarios --only step --seeds 1-3
//   corrector_scenarios --only step --seeds 1 --events    every decision of it
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <thread>

#include "tests/bench/corrector/score.h"

namespace zrobench::bench {
namespace {

struct Options {
  std::string seeds = "1-20";
  std::vector<std::string> only;
  bool baselines = false;
  bool events = false;
  bool each = false;
};

/// "3" or "1-20".
std::vector<std::uint64_t> SeedsOf(const std::string& text) {
  const std::size_t dash = text.find('-');
  const std::uint64_t first = std::stoull(text);
  const std::uint64_t last = dash == std::string::npos ? first : std::stoull(text.substr(dash + 1));
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
  return seeds;
}

std::vector<Score> RunAll(const Scenario& scenario, LearnerKind kind,
                          const std::vector<std::uint64_t>& seeds) {
  std::vector<Score> scores(seeds.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < seeds.size(); i = next++) {
      scores[i] = Run(scenario, kind, seeds[i]);
    }
  };
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) {
    workers.emplace_back(work);
  }
  for (std::thread& worker : workers) worker.join();
  return scores;
}

struct EventPrinter final : Watcher {
  void OnSample(const Instant& now, const Vector& estimate) override {
    worst_mdps_ = std::max(worst_mdps_, 1e3 * ErrorOf(estimate, now.truth_dps));
  }
  void OnEvent(const Instant& now, const zro::Event& e) override {
    fmt::print(
        "{:9.2f} s  {:6.2f} degC  code {:2}  axis {}  value {:.4f}  limit {:.4f}  error so "
        "far {:.1f}\n",
        now.t_s, static_cast<double>(e.temp_degc), static_cast<int>(e.code), e.axis,
        static_cast<double>(e.value), static_cast<double>(e.limit), worst_mdps_);
    worst_mdps_ = 0.0;
  }

 private:
  double worst_mdps_ = 0.0;
};

std::string Target(const Scenario& s) {
  if (s.target_rms_mdps == 0.0) return "";
  return fmt::format("{:g} / {:g}", s.target_rms_mdps, s.target_max_mdps);
}

bool Meets(const Scenario& s, const Summary& ours) {
  return s.target_rms_mdps == 0.0 ||
         (ours.rms_mdps <= s.target_rms_mdps && ours.max_mdps <= s.target_max_mdps);
}

std::string Pair(const Summary& s) {
  return fmt::format("{:.1f} / {:.1f}", s.rms_mdps, s.max_mdps);
}

void PrintRow(const Scenario& scenario, const Options& options,
              const std::vector<std::uint64_t>& seeds) {
  const std::vector<Score> scores = RunAll(scenario, LearnerKind::kOurs, seeds);
  const Summary ours = Summarise(scores);
  std::string row =
      fmt::format("| {:12} | {:15} | {:9} | {:4} | {:7} | {:>11} | {:4} | {:7} |", scenario.name,
                  Pair(ours), Target(scenario), Meets(scenario, ours) ? "" : "miss",
                  ours.corrupt_writes, fmt::format("{}/{}", ours.stills_learned, ours.stills),
                  ours.entries_lost, ours.stills_to_recover);
  if (options.baselines) {
    for (const LearnerKind kind : {LearnerKind::kConstant, LearnerKind::kBins}) {
      row += fmt::format(" {:15} |", Pair(Summarise(RunAll(scenario, kind, seeds))));
    }
  }
  fmt::print("{}\n", row);
  if (options.each) {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      fmt::print("    seed {}: {:.2f} / {:.1f} at {:.1f} s, {} corrupt\n", seeds[i],
                 scores[i].rms_mdps, scores[i].max_mdps, scores[i].max_at_s,
                 scores[i].corrupt_writes);
    }
  }
  std::fflush(stdout);
}

void PrintTable(const Options& options) {
  const std::vector<std::uint64_t> seeds = SeedsOf(options.seeds);
  fmt::print(
      "error of the offset vector [mdps], seeds {}: median of rms / 90th percentile of max\n",
      options.seeds);
  std::string head =
      "| scenario     | ours            | target    |      | corrupt | stills used | "
      "lost | recover |";
  std::string rule = "|---|---|---|---|---|---|---|---|";
  if (options.baselines) {
    head += " constant        | bins            |";
    rule += "---|---|";
  }
  fmt::print("{}\n{}\n", head, rule);
  for (const Scenario& scenario : Scenarios()) {
    const auto& only = options.only;
    if (only.empty() || std::find(only.begin(), only.end(), scenario.name) != only.end()) {
      PrintRow(scenario, options, seeds);
    }
  }
}

void PrintEvents(const Options& options) {
  for (const std::string& name : options.only) {
    for (const std::uint64_t seed : SeedsOf(options.seeds)) {
      EventPrinter printer;
      Run(FindScenario(name), LearnerKind::kOurs, seed, &printer);
    }
  }
}

}  // namespace
}  // namespace zrobench::bench

int main(int argc, char** argv) {
  using namespace zrobench::bench;
  CLI::App app{
      "corrector_scenarios --only cycle --seeds 1-3\nThe corrector's error in every scenario"};
  Options options;
  app.add_option("--seeds", options.seeds, "one, or first-last")->capture_default_str();
  app.add_option("--only", options.only, "scenarios by name");
  app.add_flag("--baselines", options.baselines, "beside it: a constant, and bins with a line");
  app.add_flag("--events", options.events, "every decision (needs --only)");
  app.add_flag("--each", options.each, "every seed's figures");
  CLI11_PARSE(app, argc, argv);
  try {
    options.events ? PrintEvents(options) : PrintTable(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "corrector_scenarios: {}\n", error.what());
    return 2;
  }
  return 0;
}
