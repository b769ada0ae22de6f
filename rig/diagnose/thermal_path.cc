#include "rig/diagnose/thermal_path.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "rig/physics/heat_model.h"

namespace zrobench::diagnose {
namespace {

using physics::Temperatures;

constexpr double kStartPlate_k = 0.5, kStartBoard_k = 3, kStartDie_k = 1;  ///< sd of the start

double FirstOf(const Eigen::ArrayXd& values, double otherwise) {
  for (const double v : values) {
    if (!std::isnan(v)) return v;
  }
  return otherwise;
}

/// Sums what a sensor sees during the steps of a block.
class BlockMean {
 public:
  BlockMean(std::size_t blocks, const Grid& grid, bool mean_rows)
      : means_(Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(blocks))),
        per_block_(grid.steps_per_block),
        weight_(1 / static_cast<double>(grid.steps_per_block)),
        mean_rows_(mean_rows) {}
  void Add(std::size_t step, double before, double after) {
    const double value = mean_rows_ ? 0.5 * (before + after) : after;
    means_[static_cast<Eigen::Index>(step / per_block_)] += weight_ * value;
  }
  const Eigen::ArrayXd& means() const { return means_; }

 private:
  Eigen::ArrayXd means_;
  std::size_t per_block_;
  double weight_;
  bool mean_rows_;
};

Temperatures Start(const Series& series, double die_offset_k, double ambient_degc) {
  const double plate = FirstOf(series.block[kPlateShown], ambient_degc);
  const double die = FirstOf(series.block[kDieShown], plate + die_offset_k) - die_offset_k;
  return {plate, die, die};
}

/// Van Loan (1978): transition and covariance of x' = A x + noise of density q over `dt_s`.
struct Discrete {
  Eigen::Matrix4d transition, covariance;
};
Discrete Discretise(const Eigen::Matrix4d& a, const Eigen::Matrix4d& q, double dt_s) {
  Eigen::Matrix<double, 8, 8> whole = Eigen::Matrix<double, 8, 8>::Zero();
  whole.topLeftCorner<4, 4>() = -a;
  whole.topRightCorner<4, 4>() = q;
  whole.bottomRightCorner<4, 4>() = a.transpose();
  const Eigen::Matrix<double, 8, 8> exponential = (whole * dt_s).exp();
  const Eigen::Matrix4d transition = exponential.bottomRightCorner<4, 4>().transpose();
  return {transition, transition * exponential.topRightCorner<4, 4>()};
}

/// States: errors of plate, board, die; draft.
Discrete ErrorModel(const physics::Model& model, Drive drive, const ThermalNoise& noise,
                    double dt_s) {
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a.topLeftCorner<3, 3>() = physics::ThermalNetwork(model).rates_per_s();
  a(0, 3) = model.plate.to_ambient_w_per_k / model.plate.heat_capacity_j_per_k;
  if (model.board) a(1, 3) = model.board->to_ambient_w_per_k / model.board->heat_capacity_j_per_k;
  if (drive == Drive::kPlate) a.row(0).setZero();  // the plate is an input
  a(3, 3) = -1 / kDraft_s;
  Eigen::Matrix4d q = Eigen::Matrix4d::Zero();
  q(3, 3) = 2 * noise.draft_k * noise.draft_k / kDraft_s;
  if (drive == Drive::kHeat) q(0, 0) = noise.heat_k_per_rts * noise.heat_k_per_rts;
  return Discretise(a, q, dt_s);
}

/// The node that the die's sensor follows.
Eigen::Index DieNode(const physics::Model& model) {
  return model.package ? 2 : model.board ? 1 : 0;
}

Eigen::Matrix<double, 2, 4> Sensors(const physics::Model& model) {
  Eigen::Matrix<double, 2, 4> h = Eigen::Matrix<double, 2, 4>::Zero();
  h(0, 0) = 1;
  h(1, DieNode(model)) = 1;
  return h;
}

}  // namespace

ThermalPath Simulate(const physics::Model& model, double die_offset_k, Drive drive,
                     const Series& series) {
  physics::HeatModel heat(model);
  Temperatures before = Start(series, die_offset_k, model.ambient_degc);
  heat.Place(before);
  Temperatures shown_before = before;
  const std::size_t steps = series.inputs.size();
  BlockMean plate(series.blocks(), series.grid, series.mean_rows);
  BlockMean die_shown = plate, die = plate;
  Eigen::ArrayXd die_fine(static_cast<Eigen::Index>(steps));
  for (std::size_t i = 0; i < steps; ++i) {
    if (drive == Drive::kPlate) {
      Temperatures placed = heat.temperatures();
      placed.plate_degc = series.plate_in_degc[static_cast<Eigen::Index>(i)];
      heat.Place(placed);
    }
    heat.Advance(series.grid.step_s, series.inputs[i]);
    const Temperatures now = heat.temperatures(), shown = heat.shown();
    plate.Add(i, shown_before.plate_degc, shown.plate_degc);
    die_shown.Add(i, shown_before.die_degc + die_offset_k, shown.die_degc + die_offset_k);
    die.Add(i, before.die_degc, now.die_degc);
    die_fine[static_cast<Eigen::Index>(i)] = now.die_degc;
    before = now;
    shown_before = shown;
  }
  return {plate.means(), die_shown.means(), die.means(), std::move(die_fine)};
}

ThermalFilter::ThermalFilter(const physics::Model& model, Drive drive, const ThermalNoise& noise,
                             const Series& series) {
  const Discrete error = ErrorModel(model, drive, noise, series.grid.block_s());
  const Eigen::Matrix<double, 2, 4> h = Sensors(model);
  transition_ = error.transition;
  die_node_ = DieNode(model);
  Eigen::Matrix4d p = Eigen::Vector4d(kStartPlate_k * kStartPlate_k, kStartBoard_k * kStartBoard_k,
                                      kStartDie_k * kStartDie_k, noise.draft_k * noise.draft_k)
                          .asDiagonal();
  if (drive == Drive::kPlate) p(0, 0) = 0;
  const Eigen::Vector2d variance(noise.plate_k * noise.plate_k, noise.die_k * noise.die_k);
  steps_.reserve(series.blocks());
  for (std::size_t k = 0; k < series.blocks(); ++k) {
    p = transition_ * p * transition_.transpose() + error.covariance;
    Step step{Gain::Zero(), Eigen::Vector2d::Zero()};
    // One channel after the other: the same result as both at once, and absent ones just drop out.
    // The second sees the innovation that is left after the first has been used.
    for (std::size_t c = 0; c < 2; ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      if (std::isnan(series.block[c][static_cast<Eigen::Index>(k)])) continue;
      if (c == 0 && drive != Drive::kHeat) continue;
      const double s = h.row(i).dot(p * h.row(i).transpose()) + variance[i];
      const Eigen::Vector4d gain = p * h.row(i).transpose() / s;
      p -= gain * (h.row(i) * p);
      step.gain.col(i) = gain;
      step.whiten[i] = 1 / std::sqrt(s);
      log_determinant_ += std::log(s);
    }
    steps_.push_back(step);
  }
}

ThermalFilter::Output ThermalFilter::Run(const Eigen::ArrayXd& plate_error,
                                         const Eigen::ArrayXd& die_error) const {
  const auto blocks = static_cast<Eigen::Index>(steps_.size());
  Output out{Eigen::ArrayXd::Zero(blocks), Eigen::ArrayXd::Zero(blocks),
             Eigen::ArrayXd::Zero(blocks)};
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  for (Eigen::Index k = 0; k < blocks; ++k) {
    const Step& step = steps_[static_cast<std::size_t>(k)];
    x = transition_ * x;
    if (step.whiten[0] > 0) {
      const double innovation = plate_error[k] - x[0];
      out.plate[k] = innovation * step.whiten[0];
      x += step.gain.col(0) * innovation;
    }
    if (step.whiten[1] > 0) {
      const double innovation = die_error[k] - x[die_node_];
      out.die[k] = innovation * step.whiten[1];
      x += step.gain.col(1) * innovation;
    }
    out.die_error[k] = x[die_node_];
  }
  return out;
}

}  // namespace zrobench::diagnose
