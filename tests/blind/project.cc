#include "tests/blind/project.h"

#include <Eigen/QR>
#include <algorithm>
#include <limits>

#include "tests/blind/gyro.h"

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Linear quantities may go anywhere in one step.
constexpr double kFree = 1e9;

MatrixXd Normalised(MatrixXd columns) {
  for (Index c = 0; c < columns.cols(); ++c) {
    const double length = columns.col(c).norm();
    if (length > 0) columns.col(c) /= length;
  }
  return columns;
}

}  // namespace

Span::Span(const MatrixXd& columns) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(Normalised(columns));
  qr.setThreshold(1e-7);
  basis_ = qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

MatrixXd Span::Remainder(const MatrixXd& columns) const {
  return columns - basis_ * (basis_.transpose() * columns);
}

std::vector<MatrixXd> Alternatives(const Kind& kind, const MatrixXd& columns) {
  const auto shapes = static_cast<Index>(SuspectedShapes(kind).size());
  const Index at_once = kind.grid_is_joint ? columns.cols() : columns.cols() / shapes;
  std::vector<MatrixXd> spans;
  for (Index first = 0; first < columns.cols(); first += at_once) {
    spans.emplace_back(columns.middleCols(first, at_once));
  }
  return spans;
}

Yardstick::Yardstick(const Bench& bench, Campaign campaign)
    : acoustic_(bench.knows_rectification),
      nominal_(bench.nominal),
      model_(bench.actual),
      campaign_(std::move(campaign)),
      paths_(Heat(model_, Lumps(), {}, campaign_)),
      reference_(About(model_, paths_)),
      whitener_(model_, bench.instruments, reference_, campaign_.schedules.size()),
      whitened_jacobian_(whitener_.Whiten(Jacobian())),
      nuisances_(whitened_jacobian_) {}

VectorXd Yardstick::About(const BaseModel& model, const Paths& paths) const {
  return Stack(Shown(model, campaign_, paths, {}));
}

std::vector<Yardstick::Nuisance> Yardstick::Nuisances() const {
  using M = BaseModel&;
  // Without the plate's capacity: only ratios to it can be told from temperatures and commands.
  std::vector<Nuisance> all = {
      {[](M m) -> double& { return m.ambient_degc; }, 0.01, true, 0.05},
      {[](M m) -> double& { return m.heater_w; }, 0.05, true, 0.4},
      {[](M m) -> double& { return m.cooler_w; }, 0.05, true, 0.4},
      {[](M m) -> double& { return m.plate_to_ambient_w_per_k; }, 1e-3, true, 0.4},
      {[](M m) -> double& { return m.board_j_per_k; }, 6e-3, true, 0.4},
      {[](M m) -> double& { return m.board_to_plate_w_per_k; }, 1e-3, true, 0.4},
      {[](M m) -> double& { return m.board_to_ambient_w_per_k; }, 1e-4, true, 0.4},
      {[](M m) -> double& { return m.package_s; }, 4e-3, true, 0.4},
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t power = 0; power < 4; ++power) {
      const double step = 1e-3 / std::pow(30.0, static_cast<double>(power));
      all.push_back({[=](M m) -> double& { return m.zro_dps[axis][power]; }, step, false, kFree});
    }
  }
  if (!acoustic_) return all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.push_back(
        {[=](M m) -> double& { return m.rectification_dps_per_pa2[axis]; }, 1e-4, false, 0.4});
    all.push_back({[=](M m) -> double& { return m.resonance_hz[axis]; }, 0.1, false, 5e-4});
  }
  all.push_back({[](M m) -> double& { return m.resonance_q; }, 0.5, false, 0.3});
  return all;
}

// The first power-on's is the cubic's own.
MatrixXd Yardstick::Constants() const {
  const auto later = static_cast<Index>(campaign_.schedules.size()) - 1;
  MatrixXd columns = MatrixXd::Zero(reference_.size(), 3 * later);
  for (Index at = Index{kBlocks} * kChannels; at < reference_.size(); ++at) {
    const Index channel = at % kChannels;
    const Index run = at / (kChannels * kBlocks);
    if (channel >= 2) columns(at, 3 * (run - 1) + channel - 2) = 1;
  }
  return columns;
}

MatrixXd Yardstick::Jacobian() const {
  const std::vector<Nuisance> nuisances = Nuisances();
  const MatrixXd constants = Constants();
  MatrixXd columns(reference_.size(), static_cast<Index>(nuisances.size()) + constants.cols());
  Index column = 0;
  for (const Nuisance& nuisance : nuisances) {
    BaseModel moved = model_;
    nuisance.value(moved) += nuisance.step;
    const VectorXd there =
        nuisance.heat ? About(moved, Heat(moved, Lumps(), {}, campaign_)) : About(moved, paths_);
    columns.col(column++) = (there - reference_) / nuisance.step;
  }
  columns.rightCols(constants.cols()) = constants;
  return columns;
}

MatrixXd Yardstick::Project(const MatrixXd& stacked) const {
  return nuisances_.Remainder(whitener_.Whiten(stacked));
}

BaseModel Yardstick::Step(const BaseModel& from, const VectorXd& misfit) const {
  const std::vector<Nuisance> nuisances = Nuisances();
  BaseModel model = from;
  const auto heat = std::ranges::count_if(nuisances, &Nuisance::heat);
  // Two lags nearly alike may trade places without end: a weak prior, 30 %, holds them.
  MatrixXd columns(misfit.size() + heat, whitened_jacobian_.cols());
  columns << whitened_jacobian_, MatrixXd::Zero(heat, columns.cols());
  VectorXd wanted = VectorXd::Zero(columns.rows());
  wanted.head(misfit.size()) = misfit;
  BaseModel prior = nominal_;
  for (Index i = 0; i < heat; ++i) {
    const Nuisance& nuisance = nuisances[static_cast<std::size_t>(i)];
    const double sigma = 0.3 * nuisance.value(prior);
    columns(misfit.size() + i, i) = 1 / sigma;
    wanted[misfit.size() + i] = (nuisance.value(prior) - nuisance.value(model)) / sigma;
  }
  const VectorXd length = columns.colwise().norm().cwiseMax(1e-300);
  for (Index c = 0; c < columns.cols(); ++c) columns.col(c) /= length[c];
  Eigen::ColPivHouseholderQR<MatrixXd> solver(columns);
  solver.setThreshold(1e-7);
  const VectorXd step = solver.solve(wanted).cwiseQuotient(length);
  // No further than the derivatives hold: the heat flow's quantities in step, others one by one.
  double part = 1;
  const auto most = [&](std::size_t i) {
    return nuisances[i].most_share * std::abs(nuisances[i].value(model)) /
           std::max(std::abs(step[static_cast<Index>(i)]), 1e-300);
  };
  for (std::size_t i = 0; i < nuisances.size(); ++i) {
    if (nuisances[i].heat) part = std::min(part, most(i));
  }
  for (std::size_t i = 0; i < nuisances.size(); ++i) {
    const double own = nuisances[i].heat ? part : std::min(1.0, most(i));
    nuisances[i].value(model) += own * step[static_cast<Index>(i)];
  }
  return model;
}

VectorXd Yardstick::Misfit(const BaseModel& model, const VectorXd& recording) const {
  return whitener_.Whiten(recording - Respond(model, Lumps(), {}, campaign_));
}

double Yardstick::LambdaOfMisfit(const VectorXd& recording) const {
  BaseModel model = model_;
  VectorXd misfit = whitener_.Whiten(recording - reference_);
  double best = nuisances_.Remainder(misfit).squaredNorm();
  for (int iteration = 0; iteration < 2; ++iteration) {
    model = Step(model, misfit);
    misfit = Misfit(model, recording);
    best = std::min(best, nuisances_.Remainder(misfit).squaredNorm());
  }
  return best;  // a step too far is not taken
}

bool Yardstick::MaySuspect(const Kind& kind) const {
  return !(NeedsRectification(kind.id) && !acoustic_) &&
         !(ExcludesRectification(kind.id) && acoustic_);
}

MatrixXd Yardstick::Signatures(const Kind& kind,
                               const std::vector<std::vector<double>>& shapes) const {
  const bool axes = ActsOnEachAxis(kind);
  const Index count = axes ? 3 : 1;
  MatrixXd columns(reference_.size(), count * static_cast<Index>(shapes.size()));
  Index column = 0;
  for (const std::vector<double>& shape : shapes) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) {
      Effect effect{std::string(kind.id), kind.typical, {1, 1, 1}, shape};
      if (axes) {
        effect.axes = {0, 0, 0};
        effect.axes[c] = 1;
      }
      const bool heat = kind.stage == Stage::kThermal;
      const Paths heated = heat ? Heat(model_, Lumps(), {effect}, campaign_) : Paths();
      columns.col(column++) =
          Stack(Shown(model_, campaign_, heat ? heated : paths_, {effect})) - reference_;
    }
  }
  return columns;
}

Yardstick::Alike Yardstick::NearestAlike(const VectorXd& projected,
                                         const std::vector<std::string>& except) const {
  Alike nearest{"", std::numeric_limits<double>::max()};
  for (const Kind& kind : KnownKinds()) {
    if (std::ranges::find(except, kind.id) != except.end() || !MaySuspect(kind)) continue;
    for (const MatrixXd& columns : Alternatives(kind, ColumnsOf(kind, SuspectedShapes(kind)))) {
      if (columns.norm() < 1e-6) continue;
      const double left = Span(columns).Remainder(projected).squaredNorm();
      if (left < nearest.noncentrality) nearest = {std::string(kind.id), left};
    }
  }
  return nearest;
}

}  // namespace zrobench::blind
