#include "rig/diagnose/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "rig/diagnose/gates.h"
#include "rig/diagnose/heldout.h"
#include "rig/diagnose/leftover.h"
#include "rig/diagnose/localise.h"
#include "rig/diagnose/noise_fit.h"
#include "rig/diagnose/search.h"

namespace zrobench::diagnose {
namespace {

constexpr double kNominalTolerance =
    0.9;  ///< ratios: 30 % of one value over 30 % of the plate's capacity
constexpr double kExcited =
    30;  ///< typical magnitudes: what would have to be larger is not excited

struct Candidates {
  std::vector<Effect> effects;
  std::vector<std::string> not_testable;
};

Candidates CandidatesFor(const Case& loaded, const Problem& problem) {
  Candidates all;
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < kChannels; ++i) {
    if (loaded.Has(static_cast<Channel>(i))) columns.emplace_back(kChannelNames[i]);
  }
  for (const physics::TermInfo& info : physics::Catalogue()) {
    const bool simulated = IsThermal(info) && problem.drive == Drive::kNothing;
    const bool fed = physics::UnmetNeeds(info, columns).empty() &&
                     (!info.needs_power_ons || problem.series.size() > 1);
    if (simulated || !fed || !info.scanned || info.needs_every_sample) {
      all.not_testable.emplace_back(info.id);
      continue;
    }
    for (Effect& effect : Shapes(info)) all.effects.push_back(std::move(effect));
  }
  return all;
}

/// Base fit and noise, each estimated with the other known; twice is enough.
struct Calibrated {
  Noise noise;
  Point point;
};
Calibrated Calibrate(const Problem& problem, const std::vector<Effect>& candidates,
                     const Progress& progress) {
  Calibrated now{NominalNoise(problem), {problem.nominal, 0}};
  for (const char* what : {"fitting the base model", "fitting the base model again"}) {
    progress(what);
    const Fitted base =
        Fit(problem, Filters(problem, now.point, now.noise), now.point, {KnownEffects(problem)});
    now.point = base.point;
    progress("estimating the noise");
    now.noise = EstimateNoise(problem, base, now.noise, candidates);
  }
  return now;
}

TermFound Describe(const Trial& trial, const Fitted& best, std::size_t effect,
                   std::size_t terms_tested) {
  TermFound found;
  found.info = trial.effect.info;
  const std::vector<Coefficient> coefficients = CoefficientsOf(*found.info);
  const std::vector<double> values = best.Coefficients(effect), sd = best.CoefficientSd(effect);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Coefficient& c = coefficients[k];
    const std::string axis = c.axis < 0 ? "" : fmt::format("_{}", "xyz"[c.axis]);
    const double half = 1.96 * sd[k];
    found.parameters.push_back(
        {c.parameter + axis, c.unit, values[k] * c.typical,
         std::pair{(values[k] - half) * c.typical, (values[k] + half) * c.typical}});
  }
  std::size_t shape = 0;
  for (const physics::ParameterInfo& p : found.info->parameters) {
    if (p.coefficient) continue;
    found.parameters.push_back(
        {std::string(p.name), std::string(p.unit), trial.effect.shape[shape++], std::nullopt});
  }
  for (const std::string_view channel : found.info->channels) found.channels.emplace_back(channel);
  found.log_likelihood_gain = trial.gain / 2;
  found.p_value = std::min(1.0, static_cast<double>(terms_tested) * std::exp(-trial.evidence / 2));
  return found;
}

std::vector<Limit> LimitsOf(const std::vector<Score>& scores, std::vector<std::string>& dark) {
  std::vector<Limit> limits;
  for (const Score& score : scores) {
    const std::vector<Coefficient> coefficients = CoefficientsOf(*score.effect.info);
    std::size_t best = 0;
    for (std::size_t k = 1; k < score.limit.size(); ++k) {
      if (score.limit[k] < score.limit[best]) best = k;
    }
    if (score.limit[best] > kExcited) {
      dark.emplace_back(score.effect.info->id);
      continue;
    }
    const Coefficient& c = coefficients[std::min(best, coefficients.size() - 1)];
    limits.push_back({score.effect.info, c.parameter, c.unit, score.limit[best] * c.typical});
  }
  return limits;
}

std::vector<Recalibration> Recalibrations(const Problem& problem, const Fitted& fit) {
  std::vector<Recalibration> off;
  const Point nominal{problem.nominal, 0};
  const Eigen::MatrixXd covariance = fit.Covariance();
  Eigen::Index k = 0;
  for (const Knob& knob : BaseKnobs(problem)) {
    const double sd = std::sqrt(covariance(k, k));
    ++k;
    if (!knob.logarithmic) continue;  // ambient and sensor offset are no faults of the station file
    const double away = knob.Distance(fit.point, nominal);
    if (std::fabs(away) < std::log1p(kNominalTolerance) + 2 * sd) continue;
    Point a = fit.point, b = nominal;
    off.push_back({knob.name, knob.of(b), knob.of(a), sd * knob.of(a)});
  }
  return off;
}

std::map<std::string, double> Named(const Noise& noise) {
  std::map<std::string, double> named = {{"plate_k", noise.thermal.plate_k},
                                         {"die_k", noise.thermal.die_k},
                                         {"heat_k_per_rts", noise.thermal.heat_k_per_rts},
                                         {"draft_k", noise.thermal.draft_k}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    named[fmt::format("white_{}_dps", "xyz"[axis])] = noise.gyro[axis].white_dps;
    named[fmt::format("flicker_{}_dps", "xyz"[axis])] = noise.gyro[axis].flicker_dps;
  }
  return named;
}

Outcome OutcomeOf(const SearchResult& search, const Leftover& leftover, bool off_nominal) {
  if (search.ambiguous) return Outcome::kAmbiguitySet;
  if (search.accepted.empty()) {
    if (leftover.significant) return Outcome::kUnexplained;
    return off_nominal ? Outcome::kRecalibrate : Outcome::kNoMissingPhysics;
  }
  if (!leftover.significant) return Outcome::kNamed;
  return leftover.explained_share < 0.6 ? Outcome::kUnexplained : Outcome::kPartlyExplained;
}

}  // namespace

std::string_view OutcomeName(Outcome outcome) {
  switch (outcome) {
    case Outcome::kNoMissingPhysics:
      return "no_missing_physics";
    case Outcome::kRecalibrate:
      return "recalibrate";
    case Outcome::kNamed:
      return "named";
    case Outcome::kAmbiguitySet:
      return "ambiguity_set";
    case Outcome::kPartlyExplained:
      return "partly_explained";
    case Outcome::kUnexplained:
      return "unexplained";
    case Outcome::kBusFault:
      break;
  }
  return "bus_fault";
}

Diagnosis Diagnose(const Case& loaded, const Progress& progress) {
  Diagnosis result;
  const Problem problem = Problem::Of(loaded);
  if (const std::string fault = UnfitBecause(problem); !fault.empty()) {
    result.outcome = Outcome::kBusFault;
    result.reason = fault;
    return result;
  }
  Candidates candidates = CandidatesFor(loaded, problem);
  result.not_testable = std::move(candidates.not_testable);
  const Calibrated calibrated = Calibrate(problem, candidates.effects, progress);
  const Filters filters(problem, calibrated.point, calibrated.noise);
  const Fitted base = Fit(problem, filters, calibrated.point, {KnownEffects(problem)});
  const SearchResult search = Search(problem, filters, base, candidates.effects, progress);

  progress("judging what is left");
  const Leftover leftover = Judge(problem, filters, search.base, search.best);
  result.recalibrations = Recalibrations(problem, search.base);
  result.outcome = OutcomeOf(search, leftover, !result.recalibrations.empty());
  result.threshold = search.threshold;
  result.leftover_log_p = leftover.log_p;
  result.noise = Named(calibrated.noise);
  for (const Score& score : search.first_scan) {
    result.scan.push_back({score.effect.info, score.evidence});
  }
  if (!search.first_scan.empty()) result.evidence = search.first_scan.front().evidence;
  result.limits = LimitsOf(search.first_scan, result.not_excited);
  for (const physics::TermInfo* info : search.silent) result.not_excited.emplace_back(info->id);

  if (result.outcome == Outcome::kNamed || result.outcome == Outcome::kPartlyExplained) {
    const std::size_t known = search.base.hypothesis.effects.size();
    for (std::size_t i = 0; i < search.accepted.size(); ++i) {
      result.terms.push_back(
          Describe(search.accepted[i], search.best, known + i, search.first_scan.size()));
    }
  }
  if (!search.accepted.empty()) {
    const double best = search.accepted.front().evidence;
    if (search.ambiguous) result.ambiguity.push_back(search.accepted.front().effect.info);
    for (const Trial& rival : search.rivals) {
      result.rivals.push_back({rival.effect.info, best - rival.evidence});
      if (search.ambiguous && best - rival.evidence < kAmbiguous) {
        result.ambiguity.push_back(rival.effect.info);
      }
    }
  }
  result.mismatch.detected = !search.accepted.empty() || leftover.significant;
  if (result.mismatch.detected)
    Localise(problem, calibrated.noise, search, leftover, result.mismatch);
  progress("predicting runs that the fit has not seen");
  result.errors.before = PredictionErrors(problem, filters, search.base);
  result.errors.after = PredictionErrors(problem, filters, search.best);
  const HeldOut heldout = HoldOut(problem, calibrated.noise, search.base, search.best);
  result.errors.heldout_before = heldout.before;
  result.errors.heldout_after = heldout.after;
  result.errors.noise_floor = NoiseFloor(problem, calibrated.noise);
  if (!heldout.before.empty()) {
    for (const Series& s : problem.series) result.heldout_runs.push_back(s.name);
  }
  return result;
}

}  // namespace zrobench::diagnose
