#pragma once
// The thermal model run open loop over a power-on, and the filter that turns what is left of the
// measured temperatures into innovations and into the best estimate of the die's temperature.
//
// The base network is linear, so filtering the error of an open-loop simulation is the same as
// running the Kalman filter on the measurements; the simulation may therefore be any model, also a
// non-linear one, and one filter serves it and all its sensitivities.
#include <Eigen/Core>
#include <vector>

#include "rig/diagnose/series.h"
#include "rig/physics/model.h"

namespace zrobench::diagnose {

/// What moves the temperatures.
enum class Drive {
  kHeat,     ///< drive_pct heats the plate, which the model predicts
  kPlate,    ///< the measured plate heats the board
  kNothing,  ///< no plate: the measured die temperature is what the gyro has
};

/// Block means of one run as a model has them.
struct ThermalPath {
  Eigen::ArrayXd plate_shown, die_shown;  ///< what the sensors show [degC]
  Eigen::ArrayXd die;                     ///< what the gyro has [degC]
  Eigen::ArrayXd die_fine;                ///< the same, at the end of each fine step
};

/// `die_offset_k`: the die's sensor shows that much more. Starts where the measurements start.
ThermalPath Simulate(const physics::Model& model, double die_offset_k, Drive drive,
                     const Series& series);

/// Noise of the measured temperatures, per block, and of the room.
struct ThermalNoise {
  double plate_k = 0.03;
  double die_k = 0.02;
  double heat_k_per_rts = 1e-3;  ///< white heat on the plate: its heater never does quite as told
  double draft_k = 0.05;  ///< rms of an Ornstein-Uhlenbeck process of kDraft_s on the ambient
};
inline constexpr double kDraft_s = 120;

/// Kalman filter for the errors of plate, board and die of an open-loop simulation: drafts and an
/// unknown start drive them, plate and die sensors see them. The gains depend on the model, the
/// noise and on which blocks were measured; not on the data.
class ThermalFilter {
 public:
  ThermalFilter(const physics::Model& model, Drive drive, const ThermalNoise& noise,
                const Series& series);

  struct Output {
    Eigen::ArrayXd plate, die;  ///< whitened innovations; 0 where nothing was measured
    Eigen::ArrayXd die_error;   ///< estimate of (true die - simulated die) after each block [K]
  };
  /// `plate_error`, `die_error`: measured - shown, block means; where nothing was measured their
  /// value does not matter.
  Output Run(const Eigen::ArrayXd& plate_error, const Eigen::ArrayXd& die_error) const;

  /// Sum over blocks of log |S|: what the likelihood needs beside the innovations.
  double log_determinant() const { return log_determinant_; }

 private:
  using Gain = Eigen::Matrix<double, 4, 2>;
  struct Step {
    Gain gain;               ///< columns of channels that were not measured are zero
    Eigen::Vector2d whiten;  ///< 1 / sd of the innovations; 0 likewise
  };
  Eigen::Matrix4d transition_;
  Eigen::Index die_node_;
  std::vector<Step> steps_;
  double log_determinant_ = 0;
};

}  // namespace zrobench::diagnose
