#include "rig/diagnose/noise_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

namespace zrobench::diagnose {
namespace {

constexpr double kPriorSd = 0.7;     ///< of the logarithm of an amplitude
constexpr double kRaise = 1.1;       ///< of slow noise, whose amplitude few data tell
constexpr double kLeastShare = 0.5;  ///< of the noise that the station's resolution gives
constexpr double kRidge = 1e-9;

/// -2 log of the restricted likelihood (Patterson and Thompson 1971) of y given X, both whitened.
double RestrictedCost(const Eigen::MatrixXd& x_and_y, double log_determinant) {
  const Eigen::MatrixXd gram = x_and_y.transpose() * x_and_y;
  const Eigen::Index p = gram.rows() - 1;
  Eigen::MatrixXd xx = gram.topLeftCorner(p, p);
  xx.diagonal() *= 1 + kRidge;
  xx.diagonal().array() += kRidge;
  const Eigen::LDLT<Eigen::MatrixXd> factor(xx);
  const Eigen::VectorXd xy = gram.topRightCorner(p, 1);
  const double rss = gram(p, p) - xy.dot(factor.solve(xy));
  return log_determinant + rss + factor.vectorD().array().max(kRidge).log().sum();
}

/// Minimises over logarithms of amplitudes, one after the other, with ever smaller steps.
void Search(std::vector<double*> amplitudes, const std::function<double()>& cost) {
  std::vector<double> nominal;
  for (const double* a : amplitudes) nominal.push_back(*a);
  const auto total = [&] {
    double sum = cost();
    for (std::size_t i = 0; i < nominal.size(); ++i) {
      const double away = std::log(*amplitudes[i] / nominal[i]) / kPriorSd;
      sum += away * away;
    }
    return sum;
  };
  double best = total();
  for (double step = 0.8; step > 0.04; step /= 2) {
    for (double* a : amplitudes) {
      for (const double direction : {step, -step}) {
        while (true) {
          const double before = *a;
          *a *= std::exp(direction);
          const double now = total();
          if (now < best - 1e-6) {
            best = now;
            continue;
          }
          *a = before;
          break;
        }
      }
    }
  }
}

/// Everything that may move one axis' rates, natural units: a column a run-wise series.
using Columns = std::vector<std::vector<Eigen::ArrayXd>>;

Columns RateSuspects(const Problem& problem, const Fitted& base, std::size_t axis,
                     const std::vector<Effect>& suspects) {
  Columns columns;
  const std::size_t runs = problem.series.size();
  for (std::size_t run = 0; run < runs; ++run) {
    std::vector<Eigen::ArrayXd> ones(runs);
    ones[run] = Eigen::ArrayXd::Ones(base.at.die[run].size());
    columns.push_back(std::move(ones));
  }
  for (int power = 1; power <= 3; ++power) {
    auto& column = columns.emplace_back();
    for (const Eigen::ArrayXd& die : base.at.die) column.push_back(problem.X(die).pow(power));
  }
  for (const Effect& suspect : suspects) {
    if (IsThermal(*suspect.info)) continue;
    for (RateResponse& response : RateResponses(suspect, problem, base.point.model, base.at)) {
      std::vector<Eigen::ArrayXd> column;
      for (auto& run : response.rates) column.push_back(std::move(run[axis]));
      if (column.front().size() > 0) columns.push_back(std::move(column));
    }
  }
  return columns;
}

void FitGyroNoise(const Problem& problem, const Columns& columns, std::size_t axis,
                  GyroNoise& noise) {
  const Eigen::Index rows = problem.rows() / static_cast<Eigen::Index>(kMeasured);
  const auto cost = [&] {
    Eigen::MatrixXd stack =
        Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(columns.size()) + 1);
    double log_determinant = 0;
    Eigen::Index first = 0;
    for (std::size_t run = 0; run < problem.series.size(); ++run) {
      const Eigen::ArrayXd& rates = problem.series[run].block[kRateX + axis];
      const NoiseWhitener whitener(noise, problem.block_s(),
                                   problem.series[run].Measured(kRateX + axis));
      log_determinant += whitener.log_determinant();
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k][run].size() == 0) continue;
        stack.col(static_cast<Eigen::Index>(k)).segment(first, rates.size()) =
            whitener.Whiten(columns[k][run]).matrix();
      }
      stack.rightCols(1).middleRows(first, rates.size()) = whitener.Whiten(rates).matrix();
      first += rates.size();
    }
    return RestrictedCost(stack, log_determinant);
  };
  Search({&noise.white_dps, &noise.flicker_dps}, cost);
  noise.flicker_dps *= kRaise;
}

void FitThermalNoise(const Problem& problem, const Fitted& base,
                     const std::vector<Effect>& suspects, Noise& noise) {
  // Paths do not depend on the noise: they are simulated once and filtered often.
  const Filters about(problem, base.point, noise);
  std::vector<Evaluated> moved;
  const auto probe = [&](const Point& point, const std::vector<Knob>& knobs) {
    for (const Knob& knob : knobs) {
      Point there = point;
      knob.Move(there, knob.probe);
      moved.push_back(about.Evaluate(there));
      for (std::size_t run = 0; run < problem.series.size(); ++run) {
        ThermalPath& path = moved.back().path[run];
        const ThermalPath& from = base.at.path[run];
        path.plate_shown = from.plate_shown + (path.plate_shown - from.plate_shown) / knob.probe;
        path.die_shown = from.die_shown + (path.die_shown - from.die_shown) / knob.probe;
      }
    }
  };
  probe(base.point, BaseKnobs(problem));
  for (const Effect& suspect : suspects) {
    if (!IsThermal(*suspect.info)) continue;
    Point point = base.point;
    Install(suspect, point);
    probe(point, EffectKnobs(suspect));
  }
  const auto cost = [&] {
    const Filters filters(problem, base.point, noise);
    Eigen::MatrixXd stack(problem.rows(), static_cast<Eigen::Index>(moved.size()) + 1);
    for (std::size_t k = 0; k < moved.size(); ++k) {
      stack.col(static_cast<Eigen::Index>(k)) = filters.ThermalColumn(base.at, moved[k], {});
    }
    stack.rightCols(1) = filters.TemperatureResidual(base.at);
    return RestrictedCost(stack, filters.thermal_log_determinant());
  };
  std::vector<double*> amplitudes;
  if (problem.drive == Drive::kHeat) {
    amplitudes.push_back(&noise.thermal.plate_k);
    amplitudes.push_back(&noise.thermal.heat_k_per_rts);
  }
  if (problem.measured[kDieShown]) amplitudes.push_back(&noise.thermal.die_k);
  amplitudes.push_back(&noise.thermal.draft_k);
  const ThermalNoise stated = noise.thermal;
  Search(amplitudes, cost);
  // No simulation is exact to less than the register's step: smaller would judge its arithmetic.
  noise.thermal.plate_k = std::max(noise.thermal.plate_k, kLeastShare * stated.plate_k);
  noise.thermal.die_k = std::max(noise.thermal.die_k, kLeastShare * stated.die_k);
  noise.thermal.draft_k *= kRaise;
}

}  // namespace

Noise NominalNoise(const Problem& problem) {
  const double root_rows =
      std::sqrt(static_cast<double>(problem.series.front().grid.steps_per_block));
  const double quantum = 1 / std::sqrt(12.0);
  Noise noise;
  noise.thermal.plate_k =
      std::hypot(0.02, problem.nominal.plate.resolution_degc * quantum) / root_rows;
  const double die_quantum = problem.nominal.package ? problem.nominal.package->resolution_degc : 0;
  noise.thermal.die_k = std::hypot(0.02, die_quantum * quantum) / root_rows;
  const physics::GyroModel gyro = problem.nominal.gyro.value_or(physics::GyroModel{});
  noise.gyro.fill(GyroNoise::Nominal(gyro, problem.block_s()));
  return noise;
}

Noise EstimateNoise(const Problem& problem, const Fitted& base, const Noise& start,
                    const std::vector<Effect>& suspects) {
  Noise noise = start;
  if (problem.drive != Drive::kNothing) FitThermalNoise(problem, base, suspects, noise);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!problem.measured[kRateX + axis]) continue;
    const Columns columns = RateSuspects(problem, base, axis, suspects);
    FitGyroNoise(problem, columns, axis, noise.gyro[axis]);
  }
  return noise;
}

}  // namespace zrobench::diagnose
