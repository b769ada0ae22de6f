#include "rig/diagnose/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "rig/diagnose/columns.h"

namespace zrobench::diagnose {
namespace {

constexpr std::size_t kPowers = 3;
constexpr double kLargestStep = 0.7;  ///< of a knob, in one iteration
constexpr double kFarthest = 2.3;     ///< of a relative knob from its nominal value: ten times
constexpr int kIterations = 15;

bool Sounds(const Effect& effect) { return effect.info->id.starts_with("acoustic."); }

/// Writes the resonances out where the station leaves them to the catalogue: knobs move them.
void StateResonances(Point& point) {
  for (const physics::ParameterInfo& p : physics::FindTerm("acoustic.resonance")->parameters) {
    point.model.term["acoustic.resonance"].try_emplace(std::string(p.name), p.defaults);
  }
}

/// Fits are repeated at each step of Gauss-Newton: what they share.
class Fitter {
 public:
  Fitter(const Problem& problem, const Filters& filters, const Point& start,
         const Hypothesis& hypothesis)
      : problem_(problem), filters_(filters), nominal_(start) {
    nominal_.model = problem.nominal;
    nominal_.die_offset_k = 0;
    fit_.hypothesis = hypothesis;
    fit_.point = start;
    fit_.runs = problem.series.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fit_.axes[axis] = problem.measured[kRateX + axis];
    }
    knobs_ = BaseKnobs(problem);
    if (std::ranges::any_of(hypothesis.effects, Sounds)) {
      for (Knob& knob : SoundKnobs()) knobs_.push_back(std::move(knob));
      StateResonances(fit_.point);
      StateResonances(nominal_);
    }
    for (const Effect& effect : hypothesis.effects) AddEffect(effect);
  }

  Fitted Run() {
    double cost = Linearise();
    for (int i = 0; i < kIterations && !knobs_.empty(); ++i) {
      const double before = cost;
      cost = Improve(cost);
      if (before - cost < 0.01) break;
    }
    return std::move(fit_);
  }

 private:
  void AddEffect(const Effect& effect) {
    if (!IsThermal(*effect.info)) {
      fit_.effect_columns.push_back({});  // known when the rates' columns are laid out
      return;
    }
    const std::vector<Knob> own = EffectKnobs(effect);
    fit_.effect_columns.push_back(
        {static_cast<Eigen::Index>(knobs_.size()), static_cast<Eigen::Index>(own.size())});
    const auto& there = fit_.point.model.terms;
    if (std::ranges::find(there, effect.info->id) == there.end()) Install(effect, fit_.point);
    Install(effect, nominal_);
    knobs_.insert(knobs_.end(), own.begin(), own.end());
  }

  /// Columns and residual at the present point, all linear parameters solved. Returns the cost.
  double Linearise() {
    fit_.at = filters_.Evaluate(fit_.point);
    std::vector<Eigen::VectorXd> columns;
    std::vector<double> precision;
    LayRates(columns, precision);
    const auto linear = static_cast<Eigen::Index>(columns.size());
    const auto knobs = static_cast<Eigen::Index>(knobs_.size());
    fit_.columns.resize(problem_.rows(), knobs + linear);
    fit_.precision.resize(knobs + linear);
    for (Eigen::Index k = 0; k < linear; ++k) {
      fit_.columns.col(knobs + k) = columns[static_cast<std::size_t>(k)];
      fit_.precision[knobs + k] = precision[static_cast<std::size_t>(k)];
    }
    SolveLinear(knobs);
    LayKnobs();
    return fit_.cost;
  }

  void SolveLinear(Eigen::Index knobs) {
    fit_.residual = filters_.Residual(fit_.at);
    const auto rates = fit_.columns.rightCols(fit_.columns.cols() - knobs);
    Eigen::MatrixXd normal = rates.transpose() * rates;
    normal.diagonal() += fit_.precision.tail(rates.cols());
    fit_.linear = normal.ldlt().solve(rates.transpose() * fit_.residual);
    fit_.residual -= rates * fit_.linear;
    fit_.cost = fit_.residual.squaredNorm() +
                fit_.linear.cwiseAbs2().dot(fit_.precision.tail(rates.cols()));
    for (const Knob& knob : knobs_) {
      const double distance = knob.Distance(fit_.point, nominal_) / knob.prior_sd;
      fit_.cost += distance * distance;
    }
  }

  void LayKnobs() {
    FindSlopes();
    for (std::size_t i = 0; i < knobs_.size(); ++i) {
      Point moved = fit_.point;
      knobs_[i].Move(moved, knobs_[i].probe);
      const auto k = static_cast<Eigen::Index>(i);
      fit_.columns.col(k) =
          (knobs_[i].sound
               ? SoundColumn(moved)
               : filters_.ThermalColumn(fit_.at, filters_.Evaluate(moved), fit_.slopes_dps_per_k)) /
          knobs_[i].probe;
      fit_.precision[k] = 1 / (knobs_[i].prior_sd * knobs_[i].prior_sd);
    }
  }

  /// Change of the rates when sound meets the gyro as in `moved`.
  Eigen::VectorXd SoundColumn(const Point& moved) const {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(problem_.rows());
    for (std::size_t e = 0; e < fit_.hypothesis.effects.size(); ++e) {
      const Effect& effect = fit_.hypothesis.effects[e];
      if (!Sounds(effect)) continue;
      const auto columns = RateColumnsOf(effect, problem_, moved.model, filters_, fit_.at);
      const std::vector<double> values = fit_.Coefficients(e);
      const Fitted::Range range = fit_.effect_columns[e];
      for (std::size_t k = 0; k < values.size(); ++k) {
        change +=
            values[k] * (columns[k] - fit_.columns.col(range.first + static_cast<Eigen::Index>(k)));
      }
    }
    return change;
  }

  /// Rates: per axis a constant for each power-on, x, x^2, x^3; then the effects'.
  void LayRates(std::vector<Eigen::VectorXd>& columns, std::vector<double>& precision) {
    const auto add = [&](Eigen::VectorXd column, double prior_precision) {
      columns.push_back(std::move(column));
      precision.push_back(prior_precision);
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!problem_.measured[kRateX + axis]) continue;
      for (std::size_t run = 0; run < problem_.series.size(); ++run) {
        std::vector<Eigen::ArrayXd> ones(problem_.series.size());
        ones[run] = Eigen::ArrayXd::Ones(fit_.at.die[run].size());
        add(filters_.RateColumn(axis, ones), 0);
      }
      for (int power = 1; power <= static_cast<int>(kPowers); ++power) {
        // A temperature that never moved must not make it singular.
        add(filters_.RateColumn(axis, Powers(power)), 1e-6);
      }
    }
    for (std::size_t e = 0; e < fit_.hypothesis.effects.size(); ++e) {
      const Effect& effect = fit_.hypothesis.effects[e];
      if (IsThermal(*effect.info)) continue;
      const auto first = static_cast<Eigen::Index>(knobs_.size() + columns.size());
      for (Eigen::VectorXd& column : RateColumns(effect)) {
        add(std::move(column), 1e-8);
      }
      fit_.effect_columns[e] = {first,
                                static_cast<Eigen::Index>(knobs_.size() + columns.size()) - first};
    }
  }

  std::vector<Eigen::ArrayXd> Powers(int power) const {
    std::vector<Eigen::ArrayXd> runs;
    for (const Eigen::ArrayXd& die : fit_.at.die) runs.push_back(problem_.X(die).pow(power));
    return runs;
  }
  std::vector<Eigen::VectorXd> RateColumns(const Effect& effect) const {
    return RateColumnsOf(effect, problem_, fit_.point.model, filters_, fit_.at);
  }

  /// d offset / d T of the fitted cubic, for what errs in the temperature.
  void FindSlopes() {
    fit_.slopes_dps_per_k.clear();
    for (std::size_t run = 0; run < problem_.series.size(); ++run) {
      const Eigen::ArrayXd x = problem_.X(fit_.at.die[run]);
      std::array<Eigen::ArrayXd, 3>& slopes = fit_.slopes_dps_per_k.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!problem_.measured[kRateX + axis]) continue;
        const auto b = fit_.RatesOf(axis).cubic;
        slopes[axis] = (b[0] + 2 * b[1] * x + 3 * b[2] * x.square()) / Problem::kSpan_k;
      }
    }
  }

  /// One step, damped until the cost falls. Returns the cost.
  double Improve(double cost) {
    const Eigen::MatrixXd information = fit_.Information();
    Eigen::VectorXd slope = fit_.columns.transpose() * fit_.residual;
    for (std::size_t i = 0; i < knobs_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      slope[k] -= fit_.precision[k] * knobs_[i].Distance(fit_.point, nominal_);
    }
    const auto knobs = static_cast<Eigen::Index>(knobs_.size());
    const Fitted before = fit_;
    const Eigen::ArrayXd largest = Largest();
    for (const double damping : {0.0, 0.01, 0.1, 1.0, 10.0, 100.0}) {  // Levenberg and Marquardt
      Eigen::MatrixXd damped = information;
      damped.diagonal().head(knobs) *= 1 + damping;
      const Eigen::ArrayXd step = damped.ldlt().solve(slope).head(knobs).array();
      fit_.point = before.point;
      for (std::size_t i = 0; i < knobs_.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        knobs_[i].Move(fit_.point, std::clamp(step[k], -largest[k], largest[k]));
        KeepNear(knobs_[i]);
      }
      const double moved = Linearise();
      if (moved < cost) return moved;
    }
    fit_ = before;
    return cost;
  }
  /// A model that lacks something would pay for it with a time constant of nothing.
  void KeepNear(const Knob& knob) {
    if (!knob.logarithmic) return;
    const double away = knob.Distance(fit_.point, nominal_);
    const double beyond = std::fabs(away) - kFarthest;
    if (beyond > 0) knob.Move(fit_.point, away > 0 ? -beyond : beyond);
  }
  Eigen::ArrayXd Largest() const {
    Eigen::ArrayXd largest(static_cast<Eigen::Index>(knobs_.size()));
    for (std::size_t i = 0; i < knobs_.size(); ++i) {
      largest[static_cast<Eigen::Index>(i)] =
          knobs_[i].logarithmic ? kLargestStep : 3 * std::min(knobs_[i].prior_sd, 10.0);
    }
    return largest;
  }

  const Problem& problem_;
  const Filters& filters_;
  Point nominal_;
  std::vector<Knob> knobs_;
  Fitted fit_;
};

}  // namespace

std::vector<double> Fitted::Coefficients(std::size_t effect) const {
  const Range range = effect_columns[effect];
  std::vector<double> values;
  const Effect& e = hypothesis.effects[effect];
  if (IsThermal(*e.info)) {
    Point copy = point;
    for (const Knob& knob : EffectKnobs(e)) values.push_back(knob.of(copy) / knob.unit);
    return values;
  }
  const Eigen::Index knobs = columns.cols() - linear.size();
  for (Eigen::Index k = 0; k < range.count; ++k) {
    values.push_back(linear[range.first - knobs + k]);
  }
  return values;
}

Eigen::MatrixXd Fitted::Information() const {
  Eigen::MatrixXd information = columns.transpose() * columns;
  information.diagonal() += precision;
  return information;
}

Eigen::MatrixXd Fitted::Covariance() const {
  return Information().ldlt().solve(Eigen::MatrixXd::Identity(columns.cols(), columns.cols()));
}

std::vector<double> Fitted::CoefficientSd(std::size_t effect) const {
  const Eigen::MatrixXd covariance = Covariance();
  const Range range = effect_columns[effect];
  std::vector<double> sd;
  for (Eigen::Index k = range.first; k < range.first + range.count; ++k) {
    sd.push_back(std::sqrt(covariance(k, k)));
  }
  return sd;
}

Fitted::RateParameters Fitted::RatesOf(std::size_t axis) const {
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < axis; ++i) {
    if (axes[i]) next += static_cast<Eigen::Index>(runs + kPowers);
  }
  RateParameters rates;
  for (std::size_t run = 0; run < runs; ++run) rates.constants.push_back(linear[next++]);
  for (double& b : rates.cubic) b = linear[next++];
  return rates;
}

Fitted Fit(const Problem& problem, const Filters& filters, const Point& start,
           const Hypothesis& hypothesis) {
  return Fitter(problem, filters, start, hypothesis).Run();
}

}  // namespace zrobench::diagnose
