#pragma once
// From what the sensors felt to what rows show, before noise: clocks, delays and held registers.
#include <Eigen/Core>

#include "tests/blind/effects.h"
#include "tests/blind/schedule.h"

namespace zrobench::blind {

/// One power-on's measured columns, a row a second.
struct Rows {
  Eigen::VectorXd plate_degc;
  Eigen::VectorXd die_degc;
  Eigen::MatrixXd gyro_dps;  ///< rows x 3
};

/// `line` (means over rows) as read at `time_s` after power-on, linear between rows' middles.
double ReadAt(const Eigen::VectorXd& line, double time_s);

/// By how much the board's samples are older than their row says, at each row [s].
Eigen::VectorXd BoardLag_s(const std::vector<Effect>& effects);

/// The time at which the value shown at `time_s` was taken by a register renewed every `hold_s`.
double RenewedAt_s(double time_s, double hold_s);

/// Applies lags and holds to what was felt.
Rows Sampled(const Rows& felt, const std::vector<Effect>& effects);

}  // namespace zrobench::blind
