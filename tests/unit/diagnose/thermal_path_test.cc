#include "rig/diagnose/thermal_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/diagnose/problem.h"
#include "tests/unit/diagnose/bench_recording.h"

namespace zrobench::diagnose {
namespace {

Problem SmallProblem() {
  BenchRecording recording;
  recording.seconds = 1800;
  return Problem::Of(recording.Make());
}

TEST(ThermalPath, TheTrueModelPredictsTheRecordingToItsNoise) {
  const Problem problem = SmallProblem();
  ASSERT_EQ(problem.drive, Drive::kHeat);
  for (const Series& series : problem.series) {
    const ThermalPath path = Simulate(problem.nominal, 0, problem.drive, series);
    EXPECT_LT((path.plate_shown - series.block[kPlateShown]).abs().maxCoeff(), 0.09);
    EXPECT_LT((path.die_shown - series.block[kDieShown]).abs().maxCoeff(), 0.09);
  }
}

TEST(ThermalPath, WithThePlateGivenTheDieFollows) {
  const Problem problem = SmallProblem();
  const Series& series = problem.series[0];
  const ThermalPath path = Simulate(problem.nominal, 0, Drive::kPlate, series);
  EXPECT_LT((path.die_shown - series.block[kDieShown]).abs().tail(300).maxCoeff(), 0.6);
  EXPECT_NEAR(path.die_shown.tail(1)[0], series.block[kDieShown].tail(1)[0], 0.1);
}

TEST(ThermalFilter, FindsAnErrorOfTheStartAndForgetsIt) {
  const Problem problem = SmallProblem();
  const Series& series = problem.series[0];
  const ThermalFilter filter(problem.nominal, Drive::kHeat, {}, series);
  // The die alone began 1 K beside the simulation: its error decays with the package and board.
  const auto blocks = static_cast<Eigen::Index>(series.blocks());
  Eigen::ArrayXd die(blocks);
  for (Eigen::Index k = 0; k < blocks; ++k)
    die[k] = std::exp(-5.0 * static_cast<double>(k + 1) / 4);
  const auto out = filter.Run(Eigen::ArrayXd::Zero(blocks), die);
  EXPECT_NEAR(out.die_error[0], die[0], 0.02);
  EXPECT_LT(out.die.tail(blocks - 5).abs().maxCoeff(), 0.5);
}

TEST(ThermalFilter, AbsentChannelsGiveNothing) {
  Problem problem = SmallProblem();
  Series series = problem.series[0];
  series.block[kPlateShown].setConstant(std::nan(""));
  const ThermalFilter filter(problem.nominal, Drive::kHeat, {}, series);
  const auto out =
      filter.Run(series.block[kPlateShown], Eigen::ArrayXd::Ones(series.block[1].size()));
  EXPECT_EQ(out.plate.abs().maxCoeff(), 0);
  EXPECT_TRUE(out.die.allFinite());
  EXPECT_GT(out.die.abs().maxCoeff(), 1);
}

}  // namespace
}  // namespace zrobench::diagnose
