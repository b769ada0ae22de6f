#include "tests/blind/respond.h"

#include "tests/blind/gyro.h"

namespace zrobench::blind {

using Eigen::Index;

Campaign CampaignOf(const std::vector<Schedule>& schedules, const Paths& paths) {
  Campaign campaign{schedules, {}};
  for (const ThermalPath& path : paths) campaign.command_pct.push_back(path.command_pct);
  return campaign;
}

Paths Heat(const BaseModel& model, const Solids& solids, const std::vector<Effect>& effects,
           const Campaign& campaign) {
  Paths paths;
  for (const Eigen::VectorXd& command : campaign.command_pct) {
    const Controller replayed = [&command](int row, double) { return command[row]; };
    paths.push_back(RunThermal(model, solids, effects, replayed, {}));
  }
  return paths;
}

Rows Felt(const BaseModel& model, const Schedule& schedule, int run, const ThermalPath& path,
          const std::vector<Effect>& effects) {
  const GyroHistory history{model, schedule, path.die_degc, run};
  Rows felt{path.plate_degc, path.die_degc, BaseRate_dps(history)};
  for (const Effect& effect : effects) {
    if (KindOf(effect.id).stage == Stage::kGyro) felt.gyro_dps += AddedRate_dps(history, effect);
  }
  return felt;
}

std::vector<Rows> Shown(const BaseModel& model, const Campaign& campaign, const Paths& paths,
                        const std::vector<Effect>& effects) {
  std::vector<Rows> runs;
  for (std::size_t run = 0; run < paths.size(); ++run) {
    runs.push_back(Sampled(
        Felt(model, campaign.schedules[run], static_cast<int>(run), paths[run], effects), effects));
  }
  return runs;
}

Eigen::VectorXd Stack(const std::vector<Rows>& runs) {
  Eigen::VectorXd stack(static_cast<Index>(runs.size()) * kBlocks * kChannels);
  Index at = 0;
  for (const Rows& run : runs) {
    for (Index block = 0; block < kBlocks; ++block) {
      const Index first = block * kBlockRows;
      stack[at++] = run.plate_degc.segment(first, kBlockRows).mean();
      stack[at++] = run.die_degc.segment(first, kBlockRows).mean();
      for (Index axis = 0; axis < 3; ++axis) {
        stack[at++] = run.gyro_dps.col(axis).segment(first, kBlockRows).mean();
      }
    }
  }
  return stack;
}

Eigen::VectorXd Respond(const BaseModel& model, const Solids& solids,
                        const std::vector<Effect>& effects, const Campaign& campaign) {
  return Stack(Shown(model, campaign, Heat(model, solids, effects, campaign), effects));
}

}  // namespace zrobench::blind
