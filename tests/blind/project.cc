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

Yardstick::Yardstick(const Bench& bench, Campaign campaign)
    : acoustic_(bench.knows_rectification),
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
  std::vector<Nuisance> all = {
      {[](M m) -> double& { return m.ambient_degc; }, 0.01, true},
      {[](M m) -> double& { return m.plate_j_per_k; }, 0.1, true},
      {[](M m) -> double& { return m.heater_w; }, 0.05, true},
      {[](M m) -> double& { return m.cooler_w; }, 0.05, true},
      {[](M m) -> double& { return m.plate_to_ambient_w_per_k; }, 1e-3, true},
      {[](M m) -> double& { return m.board_j_per_k; }, 6e-3, true},
      {[](M m) -> double& { return m.board_to_plate_w_per_k; }, 1e-3, true},
      {[](M m) -> double& { return m.board_to_ambient_w_per_k; }, 1e-4, true},
      {[](M m) -> double& { return m.package_s; }, 4e-3, true},
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t power = 0; power < 4; ++power) {
      const double step = 1e-3 / std::pow(30.0, static_cast<double>(power));
      all.push_back({[=](M m) -> double& { return m.zro_dps[axis][power]; }, step, false});
    }
  }
  if (!acoustic_) return all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.push_back({[=](M m) -> double& { return m.rectification_dps_per_pa2[axis]; }, 1e-4, false});
    all.push_back({[=](M m) -> double& { return m.resonance_hz[axis]; }, 0.1, false});
  }
  all.push_back({[](M m) -> double& { return m.resonance_q; }, 0.5, false});
  return all;
}

MatrixXd Yardstick::Constants() const {
  const auto runs = static_cast<Index>(campaign_.schedules.size());
  MatrixXd columns = MatrixXd::Zero(reference_.size(), 3 * runs);
  for (Index at = 0; at < reference_.size(); ++at) {
    const Index channel = at % kChannels;
    const Index run = at / (kChannels * kBlocks);
    if (channel >= 2) columns(at, 3 * run + channel - 2) = 1;
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

Yardstick::Fitted Yardstick::Fit(const VectorXd& recording) const {
  const std::vector<Nuisance> nuisances = Nuisances();
  BaseModel model = model_;
  VectorXd misfit = whitener_.Whiten(recording - reference_);
  const auto heat = std::ranges::count_if(nuisances, &Nuisance::heat);
  // Two lags nearly alike may trade places without end: a weak prior, 30 %, holds them.
  MatrixXd columns(misfit.size() + heat, whitened_jacobian_.cols());
  columns << whitened_jacobian_, MatrixXd::Zero(heat, columns.cols());
  for (Index i = 0; i < heat; ++i) {
    columns(misfit.size() + i, i) = 1 / (0.3 * nuisances[static_cast<std::size_t>(i)].value(model));
  }
  const VectorXd length = columns.colwise().norm().cwiseMax(1e-300);
  for (Index c = 0; c < columns.cols(); ++c) columns.col(c) /= length[c];
  Eigen::ColPivHouseholderQR<MatrixXd> solver(columns);
  solver.setThreshold(1e-7);
  Fitted best{model, nuisances_.Remainder(misfit)};
  for (int iteration = 0; iteration < 2; ++iteration) {
    VectorXd wanted = VectorXd::Zero(columns.rows());
    wanted.head(misfit.size()) = misfit;
    const VectorXd step = solver.solve(wanted).cwiseQuotient(length);
    for (std::size_t i = 0; i < nuisances.size(); ++i) {
      nuisances[i].value(model) += step[static_cast<Index>(i)];
    }
    misfit = whitener_.Whiten(recording - Respond(model, Lumps(), {}, campaign_));
    const VectorXd remainder = nuisances_.Remainder(misfit);
    if (remainder.squaredNorm() < best.remainder.squaredNorm()) best = {model, remainder};
  }
  return best;
}

bool Yardstick::MaySuspect(const Kind& kind) const {
  return !(NeedsRectification(kind.id) && !acoustic_) &&
         !(ExcludesRectification(kind.id) && acoustic_);
}

MatrixXd Yardstick::Signatures(const Kind& kind,
                               const std::vector<std::vector<double>>& shapes) const {
  const bool axes = kind.stage == Stage::kGyro && !NeedsRectification(kind.id);
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
    std::vector<std::vector<double>> grid = kind.grid;
    if (grid.empty()) grid.emplace_back();
    const MatrixXd all = ColumnsOf(kind, grid);
    const Index at_once = kind.grid_is_joint ? all.cols() : all.cols() / std::ssize(grid);
    for (Index first = 0; first < all.cols(); first += at_once) {
      const MatrixXd columns = all.middleCols(first, at_once);
      if (columns.norm() < 1e-6) continue;
      const double left = Span(columns).Remainder(projected).squaredNorm();
      if (left < nearest.noncentrality) nearest = {std::string(kind.id), left};
    }
  }
  return nearest;
}

}  // namespace zrobench::blind
