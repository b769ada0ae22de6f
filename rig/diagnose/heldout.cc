#include "rig/diagnose/heldout.h"

#include <cmath>

namespace zrobench::diagnose {
namespace {

struct Pool {
  double squares = 0, count = 0;
  void Add(const Eigen::ArrayXd& errors) {
    for (const double e : errors) {
      if (std::isnan(e)) continue;
      squares += e * e;
      ++count;
    }
  }
};
using Pools = std::array<Pool, kMeasured>;

PerChannel Rms(const Pools& pools) {
  PerChannel rms;
  for (std::size_t c = 0; c < kMeasured; ++c) {
    if (pools[c].count == 0) continue;
    rms[std::string(kChannelNames[Index(kMeasuredChannel[c])])] =
        std::sqrt(pools[c].squares / pools[c].count);
  }
  return rms;
}

double MeanOfMeasured(const Eigen::ArrayXd& values) {
  double sum = 0, count = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// What the fit's linear part says of one axis of one run, its constant left out.
Eigen::ArrayXd Rate(const Problem& problem, const Fitted& fit, const Evaluated& at,
                    std::size_t axis, std::size_t run) {
  const Eigen::ArrayXd x = problem.X(at.die[run]);
  const Fitted::RateParameters parameters = fit.RatesOf(axis);
  Eigen::ArrayXd rate =
      x * (parameters.cubic[0] + x * (parameters.cubic[1] + x * parameters.cubic[2]));
  for (std::size_t e = 0; e < fit.hypothesis.effects.size(); ++e) {
    const Effect& effect = fit.hypothesis.effects[e];
    if (IsThermal(*effect.info)) continue;
    const std::vector<double> values = fit.Coefficients(e);
    const std::vector<RateResponse> responses = RateResponses(effect, problem, fit.point.model, at);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Eigen::ArrayXd& one = responses[k].rates[run][axis];
      if (one.size() > 0) rate += values[k] * one;
    }
  }
  return rate;
}

void AddErrors(const Problem& problem, const Filters& filters, const Fitted& fit, Pools& pools) {
  const Evaluated at = filters.Evaluate(fit.point);
  for (std::size_t run = 0; run < problem.series.size(); ++run) {
    const Series& s = problem.series[run];
    if (!at.path.empty()) {
      if (problem.drive == Drive::kHeat) {
        pools[kPlateShown].Add(s.block[kPlateShown] - at.path[run].plate_shown);
      }
      pools[kDieShown].Add(s.block[kDieShown] - at.path[run].die_shown);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!problem.measured[kRateX + axis]) continue;
      const Eigen::ArrayXd error = s.block[kRateX + axis] - Rate(problem, fit, at, axis, run);
      pools[kRateX + axis].Add(error - MeanOfMeasured(error));
    }
  }
}

}  // namespace

PerChannel PredictionErrors(const Problem& problem, const Filters& filters, const Fitted& fit) {
  Pools pools;
  AddErrors(problem, filters, fit, pools);
  return Rms(pools);
}

HeldOut HoldOut(const Problem& problem, const Noise& noise, const Fitted& base,
                const Fitted& best) {
  if (problem.series.size() < 2) return {};
  Pools before, after;
  for (std::size_t out = 0; out < problem.series.size(); ++out) {
    std::vector<std::size_t> others;
    for (std::size_t run = 0; run < problem.series.size(); ++run) {
      if (run != out) others.push_back(run);
    }
    const Problem training = problem.Only(others), unseen = problem.Only({out});
    const Filters training_filters(training, base.point, noise);
    const Filters unseen_filters(unseen, base.point, noise);
    const auto predict = [&](const Fitted& model, Pools& pools) {
      const Fitted fit = Fit(training, training_filters, model.point, model.hypothesis);
      AddErrors(unseen, unseen_filters, fit, pools);
    };
    predict(base, before);
    predict(best, after);
  }
  return {Rms(before), Rms(after)};
}

}  // namespace zrobench::diagnose
