#include "rig/physics/thermal_network.h"

#include <algorithm>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/check.h"

namespace zrobench::physics {
namespace {

enum Node { kPlate, kBoard, kDie, kPlateHeat, kBoardHeat, kDieRate };

}  // namespace

ThermalNetwork::ThermalNetwork(const Model& model)
    : ambient_degc_(model.ambient_degc),
      plate_(model.plate),
      board_(model.board.value_or(BoardModel{})),
      has_board_(model.board.has_value()),
      has_package_(model.package.has_value()),
      x_(Eigen::Vector3d::Zero()) {
  auto& g = generator_.setZero();
  g(kPlate, kPlate) = -plate_.to_ambient_w_per_k / plate_.heat_capacity_j_per_k;
  g(kPlate, kPlateHeat) = 1 / plate_.heat_capacity_j_per_k;
  if (has_board_) {
    g(kPlate, kPlate) -= board_.to_plate_w_per_k / plate_.heat_capacity_j_per_k;
    g(kPlate, kBoard) = board_.to_plate_w_per_k / plate_.heat_capacity_j_per_k;
    g(kBoard, kPlate) = board_.to_plate_w_per_k / board_.heat_capacity_j_per_k;
    g(kBoard, kBoard) =
        -(board_.to_plate_w_per_k + board_.to_ambient_w_per_k) / board_.heat_capacity_j_per_k;
    g(kBoard, kBoardHeat) = 1 / board_.heat_capacity_j_per_k;
  } else {
    g(kPlate, kBoardHeat) = 1 / plate_.heat_capacity_j_per_k;
  }
  if (has_package_) {
    g(kDie, has_board_ ? kBoard : kPlate) = 1 / model.package->time_constant_s;
    g(kDie, kDie) = -1 / model.package->time_constant_s;
    g(kDie, kDieRate) = 1;
  }
}

void ThermalNetwork::Reset() { x_.setZero(); }

void ThermalNetwork::Place(const Temperatures& temperatures) {
  x_ << temperatures.plate_degc, temperatures.board_degc, temperatures.die_degc;
  x_.array() -= ambient_degc_;
  if (!has_board_) x_[kBoard] = 0;
  if (!has_package_) x_[kDie] = 0;
}

void ThermalNetwork::Advance(double dt_s, const HeatFlows& heat) {
  ZROBENCH_CHECK(dt_s >= 0);
  const Transition& step = TransitionFor(dt_s);
  x_ = (step.phi * x_ + step.gamma * Eigen::Vector3d(heat.plate_w, heat.board_w, heat.die_k_per_s))
           .eval();
}

const ThermalNetwork::Transition& ThermalNetwork::TransitionFor(double dt_s) {
  const auto known = std::find_if(cache_.begin(), cache_.end(),
                                  [&](const Transition& t) { return t.dt_s == dt_s; });
  if (known != cache_.end()) return *known;
  const Eigen::Matrix<double, 6, 6> whole = (generator_ * dt_s).exp();
  Transition& slot = cache_[next_slot_];
  next_slot_ = (next_slot_ + 1) % cache_.size();
  slot = {dt_s, whole.topLeftCorner<3, 3>(), whole.topRightCorner<3, 3>()};
  return slot;
}

Temperatures ThermalNetwork::temperatures() const {
  const double plate = ambient_degc_ + x_[kPlate];
  const double board = has_board_ ? ambient_degc_ + x_[kBoard] : plate;
  return {plate, board, has_package_ ? ambient_degc_ + x_[kDie] : board};
}

double ThermalNetwork::StoredHeat() const {
  const double on_board = has_board_ ? board_.heat_capacity_j_per_k * x_[kBoard] : 0;
  return plate_.heat_capacity_j_per_k * x_[kPlate] + on_board;
}

double ThermalNetwork::NetHeatFlow(const HeatFlows& heat) const {
  const double board_loss = has_board_ ? board_.to_ambient_w_per_k * x_[kBoard] : 0;
  return heat.plate_w + heat.board_w - plate_.to_ambient_w_per_k * x_[kPlate] - board_loss;
}

double ThermalNetwork::PlateHeat(double drive_pct) const {
  const double share = std::clamp(drive_pct, -100.0, 100.0) / 100;
  return share * (share > 0 ? plate_.heater_w : plate_.cooler_w);
}

}  // namespace zrobench::physics
