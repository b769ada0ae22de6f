#pragma once
// The gyro's offset, row by row, from what the package felt.
#include <Eigen/Core>

#include "tests/blind/bench.h"
#include "tests/blind/effects.h"
#include "tests/blind/schedule.h"

namespace zrobench::blind {

/// What one power-on did to the gyro. Refers to what it was made from.
struct GyroHistory {
  const BaseModel& model;
  const Schedule& schedule;
  const Eigen::VectorXd& die_degc;
  int run = 0;
};

/// Cubic in temperature and, where the model knows it, acoustic rectification: rows x 3 [dps].
Eigen::MatrixXd BaseRate_dps(const GyroHistory& history);

/// What a gyro effect adds: rows x 3 [dps]. Zero for effects of other stages.
Eigen::MatrixXd AddedRate_dps(const GyroHistory& history, const Effect& effect);

}  // namespace zrobench::blind
