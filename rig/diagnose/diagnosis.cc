#include "rig/diagnose/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rig/diagnose/gates.h"
#include "rig/diagnose/heldout.h"
#include "rig/diagnose/leftover.h"
#include "rig/diagnose/localise.h"
#include "rig/diagnose/noise_fit.h"
#include "rig/diagnose/search.h"

namespace zrobench::diagnose {
namespace {

/// Nominal values are within 30 %, and so is the plate's capacity that they are measured in.
constexpr double kNominalTolerance = 0.9;
/// Typical magnitudes: what would have to be larger to show is not excited.
constexpr double kExcited = 30;

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
    const bool timed = !info.from_power_on || loaded.station.recording.starts_at_power_on;
    const bool fed = physics::UnmetNeeds(info, columns).empty() &&
                     (!info.needs_power_ons || problem.series.size() > 1);
    if (simulated || !fed || !timed || !info.scanned || info.needs_every_sample) {
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
  found.log_likelihood_gain = trial.gain / 2;
  found.p_value = std::min(1.0, static_cast<double>(terms_tested) * std::exp(-trial.evidence / 2));
  return found;
}

std::vector<Limit> LimitsOf(const std::vector<Score>& scores, std::vector<std::string>& dark) {
  std::vector<Limit> limits;
  for (const Score& score : scores) {
    const std::vector<Coefficient> coefficients = CoefficientsOf(*score.effect.info);
    const auto least = std::ranges::min_element(score.limit);
    if (*least > kExcited) {
      dark.emplace_back(score.effect.info->id);
      continue;
    }
    const Coefficient& c = coefficients[static_cast<std::size_t>(least - score.limit.begin())];
    limits.push_back({score.effect.info, c.parameter, c.unit, *least * c.typical});
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

/// What the first look at every term saw, and what it could have seen.
void TellScan(const SearchResult& search, Diagnosis& result) {
  result.threshold = search.threshold;
  for (const Score& score : search.first_scan) {
    result.scan.push_back({score.effect.info, score.evidence});
  }
  if (!result.scan.empty()) result.evidence = result.scan.front().evidence;
  result.limits = LimitsOf(search.first_scan, result.not_excited);
  for (const physics::TermInfo* info : search.silent) result.not_excited.emplace_back(info->id);
}

/// Names where the outcome gives any; rivals and the set that cannot be told apart.
void TellTerms(const SearchResult& search, Diagnosis& result) {
  if (search.accepted.empty()) return;
  if (result.outcome == Outcome::kNamed || result.outcome == Outcome::kPartlyExplained) {
    for (std::size_t i = 0; i < search.accepted.size(); ++i) {
      result.terms.push_back(
          Describe(search.accepted[i], search.best, search.known() + i, search.first_scan.size()));
    }
  }
  const Trial& first = search.accepted.front();
  if (search.ambiguous) result.ambiguity.push_back(first.effect.info);
  for (const Trial& rival : search.rivals) {
    const double evidence_short = first.evidence - rival.evidence;
    result.rivals.push_back({rival.effect.info, evidence_short});
    if (search.ambiguous && evidence_short < kAmbiguous) {
      result.ambiguity.push_back(rival.effect.info);
    }
  }
}

Errors Predict(const Problem& problem, const Filters& filters, const Noise& noise,
               const SearchResult& search) {
  HeldOut heldout = HoldOut(problem, noise, search.base, search.best);
  return {PredictionErrors(problem, filters, search.base),
          PredictionErrors(problem, filters, search.best), std::move(heldout.before),
          std::move(heldout.after), NoiseFloor(problem, noise)};
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
  const Leftover leftover = JudgeLeftover(problem, filters, search.base, search.best);
  result.recalibrations = Recalibrations(problem, search.base);
  result.outcome = OutcomeOf(search, leftover, !result.recalibrations.empty());
  result.leftover_log_p = leftover.log_p;
  result.noise = Named(calibrated.noise);
  TellScan(search, result);
  TellTerms(search, result);
  result.mismatch.detected = !search.accepted.empty() || leftover.significant;
  if (result.mismatch.detected) {
    Localise(problem, calibrated.noise, search, leftover, result.mismatch);
  }
  progress("predicting runs that the fit has not seen");
  result.errors = Predict(problem, filters, calibrated.noise, search);
  if (!result.errors.heldout_before.empty()) {
    for (const Series& s : problem.series) result.heldout_runs.push_back(s.name);
  }
  return result;
}

}  // namespace zrobench::diagnose
