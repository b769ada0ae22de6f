#include "rig/diagnose/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rig/diagnose/chi_square.h"

namespace zrobench::diagnose {
namespace {

constexpr std::size_t kRefits = 5;
constexpr double kWorthRefit = 15;  ///< evidence short of the best score
constexpr std::uint64_t kSeed = 0x5eed;

/// Shapes between the neighbours of one in its grid: a quarter, a half, three quarters of the way.
std::vector<Effect> Between(const Effect& effect) {
  std::vector<Effect> all = {effect};
  std::size_t shape = 0;
  for (const physics::ParameterInfo& p : effect.info->parameters) {
    if (p.coefficient) continue;
    const double here = effect.shape[shape];
    for (const double next : p.grid) {
      const bool neighbour = std::ranges::none_of(p.grid, [&](double other) {
        return other != here && other != next && (other - here) * (next - other) > 0;
      });
      if (next == here || !neighbour) continue;
      for (const double share : {0.25, 0.5, 0.75}) {
        all.push_back(effect);
        const bool ratio = here > 0 && next > 0;
        all.back().shape[shape] =
            ratio ? here * std::pow(next / here, share) : here + share * (next - here);
      }
    }
    ++shape;
  }
  return all;
}

Trial Try(const Problem& problem, const Filters& filters, const Fitted& about,
          const Effect& effect) {
  Trial trial;
  const Scan finer(problem, filters, about, Between(effect));
  trial.effect = finer.scores().empty() ? effect : finer.scores().front().effect;
  Hypothesis more = about.hypothesis;
  more.effects.push_back(trial.effect);
  trial.fit = Fit(problem, filters, about.point, more);
  trial.gain = about.cost - trial.fit.cost;
  const double dof = static_cast<double>(CoefficientsOf(*effect.info).size());
  trial.evidence = -2 * LogChiSquareTail(trial.gain, dof);
  return trial;
}

std::vector<Trial> Refits(const Problem& problem, const Filters& filters, const Fitted& about,
                          const std::vector<Score>& scores) {
  std::vector<Trial> trials;
  for (const Score& score : scores) {
    if (trials.size() == kRefits) break;
    if (score.evidence <
        scores.front().evidence - std::max(kWorthRefit, 0.3 * scores.front().evidence))
      break;
    trials.push_back(Try(problem, filters, about, score.effect));
  }
  std::ranges::sort(trials, std::greater{}, &Trial::evidence);
  return trials;
}

/// Rates follow the model to their noise; temperatures do not: no plate is one lump, no heater
/// answers at once. What that leaves looks like small thermal effects, so those must show more.
double Needed(const Effect& effect, double threshold) {
  constexpr double kStructural = 12;
  return IsThermal(*effect.info) ? threshold + kStructural : threshold;
}

std::vector<Score> Above(const std::vector<Score>& scores, double threshold) {
  std::vector<Score> above;
  for (const Score& score : scores) {
    if (score.evidence >= Needed(score.effect, threshold)) above.push_back(score);
  }
  return above;
}

std::vector<Effect> Without(const std::vector<Effect>& candidates, const Hypothesis& known) {
  std::vector<Effect> rest;
  for (const Effect& effect : candidates) {
    const bool used =
        std::ranges::any_of(known.effects, [&](const Effect& k) { return k.info == effect.info; });
    if (!used) rest.push_back(effect);
  }
  return rest;
}

}  // namespace

SearchResult Search(const Problem& problem, const Filters& filters, const Fitted& base,
                    const std::vector<Effect>& candidates, const Progress& progress) {
  SearchResult result;
  result.base = base;
  result.best = base;
  while (result.accepted.size() < kMostEffects) {
    const bool first = result.accepted.empty();
    progress(fmt::format("looking for {} missing effect", first ? "a" : "another"));
    const Scan scan(problem, filters, result.best, Without(candidates, result.best.hypothesis));
    const double threshold = scan.Threshold(kAlpha, kSeed);
    if (first) {
      result.first_scan = scan.scores();
      result.silent = scan.silent();
      result.threshold = threshold;
    }
    const std::vector<Score> heard = Above(scan.scores(), threshold);
    if (heard.empty()) break;
    std::vector<Trial> trials = Refits(problem, filters, result.best, heard);
    if (trials.front().evidence < Needed(trials.front().effect, threshold)) break;
    const bool rivalled = trials.size() > 1 && trials[1].evidence > trials[0].evidence - kAmbiguous;
    if (rivalled && !first) break;  // something more is there, but not what: the rest says so
    result.accepted.push_back(trials.front());
    result.best = trials.front().fit;
    if (first) result.rivals.assign(trials.begin() + 1, trials.end());
    if (rivalled) {
      result.ambiguous = true;
      break;
    }
  }
  return result;
}

}  // namespace zrobench::diagnose
