#include "tests/bench/corrector/score.h"

#include <algorithm>
#include <cmath>

namespace zrobench::bench {
namespace {

constexpr double kCorruptDps = 0.050;
constexpr double kRecoveredDps = 0.030;

/// Follows a run and keeps its figures.
class Scorer {
 public:
  Scorer(const Scenario& scenario, const World& world, std::uint32_t reading_samples)
      : scenario_(scenario), world_(world), reading_samples_(reading_samples) {}

  void Sample(const Instant& now, const Vector& estimate_dps) {
    if (now.disturbed) {
      disturbed_at_ = static_cast<std::int64_t>(n_);
      recovering_ = true;
      clean_ = 0;
    }
    if (now.still && now.period != period_) {
      period_ = now.period;
      ++score_.stills;
      learned_ = false;
      if (!now.disturbed) ++clean_;
    }
    const double error = ErrorOf(estimate_dps, now.truth_dps);
    Recover(now, error);
    if (now.t_s >= scenario_.score_from_s) {
      squares_ += error * error;
      ++scored_;
    }
    const double max_from_s = std::max(scenario_.score_from_s, scenario_.score_max_from_s);
    if (now.t_s >= max_from_s && error * 1e3 > score_.max_mdps) {
      score_.max_mdps = error * 1e3;
      score_.max_at_s = now.t_s;
    }
    ++n_;
  }

  void Event(const Instant& now, const zro::Event& event) {
    if ((zro::IsWrite(event.code) || event.code == zro::Code::kRecentNothingToDo) && !learned_) {
      learned_ = true;
      ++score_.stills_learned;
    }
    if (!zro::IsWrite(event.code)) return;
    const Vector truth = world_.CurveAt(static_cast<double>(event.temp_degc), now.t_s);
    bool corrupt = disturbed_at_ >= 0 && static_cast<std::int64_t>(n_) - disturbed_at_ <=
                                             static_cast<std::int64_t>(reading_samples_);
    for (std::size_t i = 0; i < 3; ++i) {
      corrupt =
          corrupt || std::abs(static_cast<double>(event.measured_dps[i]) - truth[i]) > kCorruptDps;
    }
    score_.corrupt_writes += corrupt ? 1 : 0;
  }

  Score Finish() {
    score_.rms_mdps =
        1e3 * std::sqrt(squares_ / static_cast<double>(std::max<std::int64_t>(1, scored_)));
    return score_;
  }
  Score& score() { return score_; }

 private:
  void Recover(const Instant& now, double error) {
    const double still_ends_s = scenario_.still_s - 0.05;
    const double within_s = now.t_s - now.period * (scenario_.still_s + scenario_.motion_s);
    if (!recovering_ || now.disturbed || !now.still || within_s < still_ends_s) return;
    if (error > kRecoveredDps) {
      score_.stills_to_recover = std::max(score_.stills_to_recover, clean_ + 1);
    } else {
      score_.stills_to_recover = std::max(score_.stills_to_recover, clean_);
      recovering_ = false;
    }
  }

  const Scenario& scenario_;
  const World& world_;
  std::uint32_t reading_samples_;
  Score score_;
  double squares_ = 0.0;
  std::int64_t scored_ = 0;
  std::uint64_t n_ = 0;
  std::int64_t disturbed_at_ = -1;
  int period_ = -1;
  int clean_ = 0;
  bool recovering_ = false;
  bool learned_ = false;
};

/// Reboots and dates fall due.
class Schedule {
 public:
  explicit Schedule(const Scenario& scenario) : scenario_(scenario) {}
  void Apply(double t_s, Learner* learner, Score* score) {
    if (scenario_.date_at_s && !set_back_ && t_s >= *scenario_.date_at_s) {
      set_back_ = true;
      learner->SetDate(static_cast<std::uint16_t>(*scenario_.date - 365));
    }
    const std::optional<double>& at =
        scenario_.cut_at_s ? scenario_.cut_at_s : scenario_.reboot_at_s;
    if (!at || booted_ || t_s < *at) return;
    booted_ = true;
    score->entries_lost = learner->Reboot(!scenario_.cut_at_s);
  }

 private:
  const Scenario& scenario_;
  bool set_back_ = false;
  bool booted_ = false;
};

double Quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

}  // namespace

double ErrorOf(const Vector& estimate_dps, const Vector& truth_dps) {
  double squares = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    squares += (estimate_dps[i] - truth_dps[i]) * (estimate_dps[i] - truth_dps[i]);
  }
  return std::sqrt(squares);
}

Score Run(const Scenario& scenario, LearnerKind kind, std::uint64_t seed, Watcher* watcher) {
  World world(scenario, seed);
  const std::unique_ptr<Learner> learner = MakeLearner(kind, scenario.sample_hz);
  learner->LoadFactory(FactoryOf(scenario, seed));
  if (scenario.date) learner->SetDate(static_cast<std::uint16_t>(*scenario.date));
  Scorer scorer(scenario, world, learner->ReadingSamples());
  Schedule schedule(scenario);
  std::vector<zro::Event> events;
  Vector estimate{};
  for (Instant now; world.Next(&now);) {
    schedule.Apply(now.t_s, learner.get(), &scorer.score());
    if (now.comes) estimate = learner->Step(now.sample);
    events.clear();
    learner->TakeEvents(&events);
    scorer.Sample(now, estimate);
    for (const zro::Event& event : events) {
      scorer.Event(now, event);
      if (watcher != nullptr) watcher->OnEvent(now, event);
    }
    if (watcher != nullptr) watcher->OnSample(now, estimate);
  }
  return scorer.Finish();
}

Summary Summarise(const std::vector<Score>& scores) {
  Summary all;
  std::vector<double> rms, max;
  for (const Score& s : scores) {
    rms.push_back(s.rms_mdps);
    max.push_back(s.max_mdps);
    all.corrupt_writes += s.corrupt_writes;
    all.stills += s.stills;
    all.stills_learned += s.stills_learned;
    all.entries_lost = std::max(all.entries_lost, s.entries_lost);
    all.stills_to_recover = std::max(all.stills_to_recover, s.stills_to_recover);
  }
  all.rms_mdps = Quantile(rms, 0.5);
  all.max_mdps = Quantile(max, 0.9);
  return all;
}

}  // namespace zrobench::bench
