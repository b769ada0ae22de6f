#pragma once
// The linear heat network of the base equations, moved through time without discretisation error.
#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "rig/physics/model.h"
#include "rig/physics/rig_model.h"

namespace zrobench::physics {

/// Plate, board and package of the base equations (model.h) as one linear system
/// x' = A x + B u in temperatures above ambient. For u constant over a step the solution is exact:
/// exp([A B; 0 0] dt) holds both transition matrices (Van Loan 1978). A model without a board has
/// the board's quantities at the plate, one without a package has the die at the board.
class ThermalNetwork {
 public:
  /// `model` is valid (Validate). Starts at ambient.
  explicit ThermalNetwork(const Model& model);

  void Reset();
  /// The nodes at these temperatures; those the model does not have are ignored.
  void Place(const Temperatures& temperatures);
  /// Moves time on by `dt_s` >= 0 with `heat` held. Matrices are kept for the latest step lengths.
  void Advance(double dt_s, const HeatFlows& heat);

  Temperatures temperatures() const;
  /// A of x' = A x + ..., x = plate, board, die above ambient [1/s]; rows of absent nodes are zero.
  Eigen::Matrix3d rates_per_s() const { return generator_.topLeftCorner<3, 3>(); }
  /// Heat stored above ambient [J]. The package stores none: it follows the board.
  double StoredHeat() const;
  /// What flows in from outside minus what is lost to ambient [W]; the rate of StoredHeat.
  double NetHeatFlow(const HeatFlows& heat) const;
  /// What the plate's actuator delivers at `drive_pct`, saturating at -100 and 100 % [W].
  double PlateHeat(double drive_pct) const;

 private:
  struct Transition {
    double dt_s = -1;  ///< no step has this length
    Eigen::Matrix3d phi;
    Eigen::Matrix3d gamma;
  };
  const Transition& TransitionFor(double dt_s);

  double ambient_degc_;
  PlateModel plate_;
  BoardModel board_;
  bool has_board_;
  bool has_package_;
  Eigen::Matrix<double, 6, 6> generator_;  ///< [A B; 0 0] in 1/s
  Eigen::Vector3d x_;                      ///< plate, board, die above ambient [K]
  std::array<Transition, 8> cache_;
  std::size_t next_slot_ = 0;
};

}  // namespace zrobench::physics
