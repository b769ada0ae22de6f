#include "rig/diagnose/leftover.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "rig/diagnose/chi_square.h"

namespace zrobench::diagnose {
namespace {

constexpr int kBumps = 10;
constexpr double kSignificant = -18.4;  ///< log of 1e-8: small effects below the limits add up

/// No plate is one lump: gradients within it leave this much in any recording (chi-square).
constexpr double kStructural = 250;

/// Shapes over one run, a block each; the same number for every run.
using Shapes = std::vector<Eigen::ArrayXd>;

Eigen::ArrayXd Bump(const Eigen::ArrayXd& x, double centre, double width) {
  return (-0.5 * ((x - centre) / width).square()).exp();
}

struct Span {
  double low = 1e300, high = -1e300;
  double step() const { return std::max(high - low, 1e-6) / (kBumps - 1); }
};

Eigen::ArrayXd RateOfChange(const Eigen::ArrayXd& die, double block_s) {
  const Eigen::Index n = die.size();
  Eigen::ArrayXd rate = Eigen::ArrayXd::Zero(n);
  if (n > 2) rate.segment(1, n - 2) = (die.tail(n - 2) - die.head(n - 2)) / (2 * block_s);
  return rate;
}

Eigen::ArrayXd BlockPressureSquares(const Series& s) {
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(s.blocks()));
  for (std::size_t i = 0; i < s.inputs.size(); ++i) {
    squares[static_cast<Eigen::Index>(i / s.grid.steps_per_block)] +=
        s.inputs[i].tone_pa * s.inputs[i].tone_pa;
  }
  return squares;
}

Shapes ShapesOf(const Series& series, const Eigen::ArrayXd& die, const Span& span) {
  Shapes shapes;
  const Eigen::ArrayXd rate = RateOfChange(die, series.grid.block_s());
  const Eigen::ArrayXd x = (die - span.low) / std::max(span.high - span.low, 1e-6);
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(die.size(), 0, 1);
  for (int i = 0; i < kBumps; ++i) {
    shapes.push_back(Bump(die, span.low + i * span.step(), span.step()));
  }
  for (int i = 0; i < 4; ++i) shapes.push_back(Bump(t, i / 3.0, 1 / 3.0));
  const Eigen::ArrayXd sign = (rate / 0.005).tanh();
  for (const Eigen::ArrayXd& each :
       {rate, Eigen::ArrayXd(rate.abs()), Eigen::ArrayXd(rate * x), Eigen::ArrayXd(rate.abs() * x),
        sign, Eigen::ArrayXd(sign * x)}) {
    shapes.push_back(each);
  }
  const Eigen::ArrayXd sound = BlockPressureSquares(series);
  shapes.push_back(sound);
  shapes.push_back(sound * x);
  return shapes;
}

enum class About { kTemperatures, kRates };

std::vector<Eigen::VectorXd> Dictionary(const Problem& problem, const Filters& filters,
                                        const Fitted& fit, About about) {
  Span span;
  for (const Eigen::ArrayXd& die : fit.at.die) {
    span.low = std::min(span.low, die.minCoeff());
    span.high = std::max(span.high, die.maxCoeff());
  }
  std::vector<Shapes> runs;
  for (std::size_t run = 0; run < problem.series.size(); ++run) {
    runs.push_back(ShapesOf(problem.series[run], fit.at.die[run], span));
  }
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t k = 0; k < runs.front().size(); ++k) {
    std::vector<Eigen::ArrayXd> shape;
    for (const Shapes& run : runs) shape.push_back(run[k]);
    for (std::size_t axis = 0; about == About::kRates && axis < 3; ++axis) {
      if (problem.measured[kRateX + axis]) columns.push_back(filters.RateColumn(axis, shape));
    }
    if (about == About::kRates || fit.at.path.empty()) continue;
    // The same shapes on what each temperature sensor shows.
    for (const bool on_plate : {true, false}) {
      Evaluated moved = fit.at;
      for (std::size_t run = 0; run < runs.size(); ++run) {
        (on_plate ? moved.path[run].plate_shown : moved.path[run].die_shown) += shape[run];
      }
      columns.push_back(filters.ThermalColumn(fit.at, moved, {}));
    }
  }
  return columns;
}

struct Seen {
  double chi_square = 0, rank = 0;
  double excess() const { return chi_square - rank; }
  Eigen::VectorXd fitted;
};

Seen See(const std::vector<Eigen::VectorXd>& columns, const Fitted& fit) {
  if (columns.empty()) return {0, 0, Eigen::VectorXd::Zero(fit.residual.size())};
  Eigen::MatrixXd d(fit.residual.size(), static_cast<Eigen::Index>(columns.size()));
  Eigen::Index used = 0;
  for (const Eigen::VectorXd& column : columns) {
    const double length = column.norm();
    if (length > 1e-9) d.col(used++) = column / length;
  }
  d.conservativeResize(Eigen::NoChange, used);
  d -= fit.columns * fit.Information().ldlt().solve(fit.columns.transpose() * d);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(d.transpose() * d);
  Seen seen;
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(used);
  for (Eigen::Index i = 0; i < used; ++i) {
    if (eigen.eigenvalues()[i] < 1e-4) continue;
    inverse[i] = 1 / eigen.eigenvalues()[i];
    ++seen.rank;
  }
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * (d.transpose() * fit.residual);
  seen.chi_square = along.cwiseAbs2().dot(inverse);
  seen.fitted = d * (eigen.eigenvectors() * along.cwiseProduct(inverse));
  return seen;
}

}  // namespace

Leftover JudgeLeftover(const Problem& problem, const Filters& filters, const Fitted& base,
                       const Fitted& best) {
  Leftover leftover;
  leftover.fitted = Eigen::VectorXd::Zero(problem.rows());
  double before_excess = 0, after_excess = 0;
  for (const About about : {About::kTemperatures, About::kRates}) {
    const Seen before = See(Dictionary(problem, filters, base, about), base);
    const Seen after = See(Dictionary(problem, filters, best, about), best);
    before_excess += std::max(before.excess(), 0.0);
    after_excess += std::max(after.excess(), 0.0);
    const double log_p = LogChiSquareTail(after.chi_square, after.rank);
    leftover.log_p = std::min(leftover.log_p, log_p);
    const double allowed = about == About::kTemperatures ? kStructural : 0;
    if (log_p < kSignificant && after.excess() > allowed) leftover.significant = true;
    leftover.fitted += after.fitted;
  }
  leftover.explained_share = 1 - after_excess / std::max(before_excess, 1e-9);
  return leftover;
}

}  // namespace zrobench::diagnose
