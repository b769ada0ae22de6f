#pragma once
// A campaign of power-ons, simulated without noise.
#include <Eigen/Core>
#include <vector>

#include "tests/blind/bench.h"
#include "tests/blind/effects.h"
#include "tests/blind/sampling.h"
#include "tests/blind/schedule.h"
#include "tests/blind/thermal.h"

namespace zrobench::blind {

inline constexpr int kChannels = 5;   ///< plate, die, gyro x, y, z
inline constexpr int kBlockRows = 5;  ///< rows averaged before anything is weighed
inline constexpr int kBlocks = kRunRows / kBlockRows;

/// What was done: schedules, and the commands [%] the controller gave row by row.
struct Campaign {
  std::vector<Schedule> schedules;
  std::vector<Eigen::VectorXd> command_pct;
};

using Paths = std::vector<ThermalPath>;

/// As done in runs that took these paths.
Campaign CampaignOf(const std::vector<Schedule>& schedules, const Paths& paths);

/// Heat flow of every run under the campaign's commands. Effects of other stages are ignored.
Paths Heat(const BaseModel& model, const Solids& solids, const std::vector<Effect>& effects,
           const Campaign& campaign);

/// What one power-on's sensors feel, before clocks, holds, noise and registers.
Rows Felt(const BaseModel& model, const Schedule& schedule, int run, const ThermalPath& path,
          const std::vector<Effect>& effects);

/// What rows show, without noise, given the heat flow.
std::vector<Rows> Shown(const BaseModel& model, const Campaign& campaign, const Paths& paths,
                        const std::vector<Effect>& effects);

/// Block means, ordered run, block, channel.
Eigen::VectorXd Stack(const std::vector<Rows>& runs);

/// Heat, Shown and Stack in one.
Eigen::VectorXd Respond(const BaseModel& model, const Solids& solids,
                        const std::vector<Effect>& effects, const Campaign& campaign);

}  // namespace zrobench::blind
