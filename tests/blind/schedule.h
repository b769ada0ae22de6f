#pragma once
// What is done to the bench in one power-on, second by second. Drawn without regard to what will
// be hidden, so that it carries no label.
#include <Eigen/Core>
#include <vector>

#include "tests/blind/bench.h"

namespace zrobench::blind {

inline constexpr int kRunRows = 7200;  ///< rows of one run, 1 s each

/// Each vector has kRunRows elements and holds from its second to the next.
struct Schedule {
  Eigen::VectorXd setpoint_degc;
  Eigen::VectorXd supply_v;
  Eigen::VectorXd tone_hz;  ///< 0: silent
  Eigen::VectorXd tone_spl_db;
  Eigen::VectorXd vibration_g;  ///< rms of broadband shaking
  Eigen::MatrixXd gravity_g;    ///< rows x 3
  Eigen::VectorXd moving;       ///< 1 where the board is being turned: its columns are blank
  double started_h = 0;         ///< after the first run's start
};

/// Four power-ons in drawn order: steps, triangles at two rates, a staircase, pseudo-random steps;
/// each begins with an all-equal soak.
std::vector<Schedule> DrawSchedules(Draw draw, const Bench& bench);

/// Sound pressure of a row's tone [Pa rms], 0 when silent.
double TonePressure_pa(const Schedule& schedule, int row);

}  // namespace zrobench::blind
