#include "tests/blind/baselines.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Upper 1 % / 33 candidates of chi-square with 1, 2, 3 ... degrees of freedom.
double Threshold(Index freedom) {
  // Wilson and Hilferty (1931); normal quantile of 0.01 / 33.
  constexpr double kNormal = 3.43;
  const double f = static_cast<double>(freedom);
  return f * std::pow(1 - 2 / (9 * f) + kNormal * std::sqrt(2 / (9 * f)), 3);
}

// Every channel in units of its own scatter.
MatrixXd Scaled(const MatrixXd& signals, const VectorXd& residual) {
  VectorXd energy = VectorXd::Zero(kChannels);
  for (Index at = 0; at < residual.size(); ++at)
    energy[at % kChannels] += residual[at] * residual[at];
  const VectorXd scatter =
      (energy / (static_cast<double>(residual.size()) / kChannels)).cwiseSqrt().cwiseMax(1e-12);
  MatrixXd scaled = signals;
  for (Index at = 0; at < signals.rows(); ++at) scaled.row(at) /= scatter[at % kChannels];
  return scaled;
}

// What a span explains of a signal.
double Explained(const MatrixXd& columns, const VectorXd& signal) {
  if (columns.norm() < 1e-6) return 0;
  return signal.squaredNorm() - Span(columns).Remainder(signal).squaredNorm();
}

struct Best {
  std::string id;
  double excess = 0;  // over its own threshold
};

template <typename ColumnsOf>
Best BestOf(const BaseFit& fit, const VectorXd& signal, const ColumnsOf& columns_of) {
  Best best;
  for (const Kind& kind : KnownKinds()) {
    if (!fit.yard.MaySuspect(kind)) continue;
    const auto shapes = SuspectedShapes(kind);
    for (const MatrixXd& columns : Alternatives(kind, columns_of(kind, shapes))) {
      const double excess = Explained(columns, signal) - Threshold(columns.cols());
      if (excess > best.excess) best = {std::string(kind.id), excess};
    }
  }
  return best;
}

Named Naming(const Best& best) { return best.id.empty() ? Named{} : Named{best.id}; }

// Stacked rows of one gyro axis.
VectorXd AxisOf(const VectorXd& stacked, Index axis) {
  VectorXd line(stacked.size() / kChannels);
  for (Index i = 0; i < line.size(); ++i) line[i] = stacked[i * kChannels + 2 + axis];
  return line;
}

// Die temperature and its rate as measured, time in its run [h].
MatrixXd TemperatureRateTime(const VectorXd& stacked) {
  MatrixXd features(stacked.size() / kChannels, 3);
  for (Index i = 0; i < features.rows(); ++i) {
    const Index block = i % kBlocks;
    const Index before = block > 0 ? i - 1 : i;
    const double now = stacked[i * kChannels + 1];
    features.row(i) << (now - kReferenceDegc) / 40,
        (now - stacked[before * kChannels + 1]) / kBlockRows,
        static_cast<double>(block * kBlockRows) / 3600;
  }
  return features;
}

const std::vector<std::string>& AlgebraicIds() {
  static const std::vector<std::string> ids = {"gyro.temperature_rate", "gyro.temperature_curve",
                                               "gyro.supply", "gyro.g_sensitivity",
                                               "gyro.vibration_rectification"};
  return ids;
}

}  // namespace

BaseModel FittedModel(const Recording& recording) {
  Bench bench = recording.bench;
  for (int round = 0; round < 8; ++round) {
    const Yardstick yard(bench, recording.campaign);
    bench.actual = yard.Step(bench.actual, yard.Misfit(bench.actual, recording.stacked));
  }
  return bench.actual;
}

Named ByCorrelation(const BaseFit& fit) {
  const VectorXd residual = Scaled(fit.residual, fit.residual);
  return Naming(BestOf(fit, residual, [&fit](const Kind& kind, const auto& shapes) {
    return Scaled(fit.yard.Signatures(kind, shapes), fit.residual);
  }));
}

Named ByLikelihoodRatio(const BaseFit& fit) {
  return Naming(BestOf(fit, fit.remainder, [&fit](const Kind& kind, const auto& shapes) {
    return fit.yard.ColumnsOf(kind, shapes);
  }));
}

Named Oracle(const BaseFit& fit, const std::vector<std::string>& truth) {
  Named named;
  for (const std::string& id : truth) {
    if (!IsKnown(id)) continue;
    const Kind& kind = KindOf(id);
    const auto spans = Alternatives(kind, fit.yard.ColumnsOf(kind, SuspectedShapes(kind)));
    const bool significant = std::ranges::any_of(spans, [&fit](const MatrixXd& columns) {
      return Explained(columns, fit.remainder) > Threshold(columns.cols());
    });
    if (significant) named.push_back(id);
  }
  return named;
}

Named ByStlsq(const BaseFit& fit) {
  constexpr double kThreshold_dps = 1e-3;
  MatrixXd library(fit.residual.size() / kChannels, 0);
  for (const std::string& id : AlgebraicIds()) {
    const Kind& kind = KindOf(id);
    const MatrixXd columns = fit.yard.Signatures(kind, {SuspectedShapes(kind).front()});
    library.conservativeResize(Eigen::NoChange, library.cols() + 1);
    library.rightCols(1) = AxisOf(columns.col(0), 0);  // its own regressor: axis x driven alone
    const double scale = library.rightCols(1).cwiseAbs().maxCoeff();
    if (scale > 0) library.rightCols(1) /= scale;
  }
  Named named;
  for (Index axis = 0; axis < 3; ++axis) {
    const VectorXd target = AxisOf(fit.residual, axis);
    VectorXd active = VectorXd::Ones(library.cols());
    for (int round = 0; round < 10; ++round) {
      const MatrixXd used = library * active.asDiagonal();
      const VectorXd weight = Eigen::CompleteOrthogonalDecomposition<MatrixXd>(used).solve(target);
      for (Index c = 0; c < library.cols(); ++c) {
        active[c] = std::abs(weight[c]) * active[c] > kThreshold_dps ? 1 : 0;
      }
    }
    for (Index c = 0; c < library.cols(); ++c) {
      const std::string& id = AlgebraicIds()[static_cast<std::size_t>(c)];
      if (active[c] > 0 && std::ranges::find(named, id) == named.end()) named.push_back(id);
    }
  }
  return named;
}

double RidgeHeldOutShare(const BaseFit& fit) {
  const MatrixXd raw = TemperatureRateTime(fit.recording.stacked);
  MatrixXd features(raw.rows(), 7);
  for (Index i = 0; i < raw.rows(); ++i) {
    const double x = raw(i, 0);
    features.row(i) << 1, x, x * x, x * x * x, raw(i, 1), raw(i, 2), x * raw(i, 1);
  }
  const Index train = raw.rows() - kBlocks;
  const MatrixXd known = features.topRows(train);
  const MatrixXd normal = known.transpose() * known + 1e-3 * MatrixXd::Identity(7, 7);
  double left = 0, before = 0;
  for (Index axis = 0; axis < 3; ++axis) {
    const VectorXd target = AxisOf(fit.residual, axis);
    const VectorXd weight = normal.ldlt().solve(known.transpose() * target.head(train));
    left += (target.tail(kBlocks) - features.bottomRows(kBlocks) * weight).squaredNorm();
    before += target.tail(kBlocks).squaredNorm();
  }
  return std::sqrt(left / before);
}

}  // namespace zrobench::blind
