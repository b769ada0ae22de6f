#pragma once
// One bench at work: the controller in its loop, the noise, the registers, the rows of a log.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/blind/respond.h"

namespace zrobench::blind {

/// Heat flow with the loop closed: what happened, drafts and the controller's own noise included.
/// The same seed gives the same noise whatever the effects.
Paths CloseLoop(const Bench& bench, const std::vector<Schedule>& schedules,
                const std::vector<Effect>& effects, std::uint64_t seed);

/// `value` as a register of this step shows it.
double Register(double value, double step);

/// The CSV text of one power-on.
std::string LogText(const Bench& bench, const Schedule& schedule, const Rows& felt,
                    const Eigen::VectorXd& command_pct, const std::vector<Effect>& effects,
                    Draw draw);

/// The station file: nominal values only.
std::string StationText(const Bench& bench, const std::vector<Schedule>& schedules);

}  // namespace zrobench::blind
