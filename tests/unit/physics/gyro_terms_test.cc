// Each effect on the gyro against its law, written out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rig/physics/rig_model.h"
#include "rig/physics/term.h"

namespace zrobench::physics {
namespace {

constexpr double kPeriodS = 1;

/// One term alone, fed with a temperature and whatever else, a second a sample.
class Bench {
 public:
  Bench(std::string id, TermParameters parameters) : info_(*FindTerm(id)) {
    Model model;
    model.term[id] = std::move(parameters);
    EXPECT_TRUE(FindErrors(model).empty()) << FindErrors(model).front().message;
    parameters_ = FlatParameters(info_, model);
    states_.resize(info_.states);
    info_.term->Place({}, states_);
    PowerOn();
  }
  void PowerOn() { info_.term->PowerOn(states_); }
  Axes At(double die_degc, const Inputs& inputs = {}, double die_k_per_s = 0) {
    const TermContext context{inputs, {0, 0, die_degc}, kPeriodS, {}, die_k_per_s, 1, false};
    info_.term->Step(context, parameters_, states_);
    Sensed sensed;
    info_.term->Output(context, parameters_, states_, sensed);
    return sensed.rate_dps;
  }
  /// The Y axis along a path of temperatures.
  std::vector<double> Along(const std::vector<double>& path_degc) {
    std::vector<double> rate_dps;
    for (const double die_degc : path_degc) rate_dps.push_back(At(die_degc)[1]);
    return rate_dps;
  }

 private:
  const TermInfo& info_;
  std::vector<double> parameters_, states_;
};

/// From one temperature to the next in equal steps of at most `step_k`, the first included.
std::vector<double> Path(const std::vector<double>& corners_degc, double step_k) {
  std::vector<double> path = {corners_degc.front()};
  for (std::size_t i = 1; i < corners_degc.size(); ++i) {
    const double from = corners_degc[i - 1], to = corners_degc[i];
    const double steps = std::ceil(std::fabs(to - from) / step_k);
    for (double k = 1; k <= steps; ++k) path.push_back(from + (to - from) * k / steps);
  }
  return path;
}

TermParameters Play(double width_k) {
  return {{"dps_per_40k", {0, 0.04, 0}}, {"width_k", {width_k}}};
}

TEST(Backlash, LagsByHalfItsWidthOnEitherWayAndIsFlatInBetween) {
  Bench bench("gyro.backlash", Play(5));
  // 1 mdps per kelvin of play. Starts where it is, rises once the gap of 5 K has closed ...
  EXPECT_NEAR(bench.Along(Path({20, 25}, 0.5)).back(), -0.005, 1e-12);
  const double rising_dps = bench.Along(Path({25, 40}, 0.5)).back();
  EXPECT_NEAR(bench.Along(Path({40, 60}, 0.5)).back(), 0.030, 1e-12);
  // ... stands still over 2 w after the reversal, then follows 5 K above.
  for (const double rate_dps : bench.Along(Path({60, 50}, 0.5))) {
    EXPECT_NEAR(rate_dps, 0.030, 1e-12);
  }
  const double falling_dps = bench.Along(Path({50, 40}, 0.5)).back();
  EXPECT_NEAR(falling_dps - rising_dps, 0.010, 1e-12);  // 2 w c
}

TEST(Backlash, KnowsNeitherRateNorHolds) {
  Bench slow("gyro.backlash", Play(3)), fast("gyro.backlash", Play(3));
  const std::vector<double> corners = {20, 55, 30, 48, 46, 10};
  std::vector<double> held = Path(corners, 0.1);
  held.insert(held.begin() + 500, 600, held[500]);
  EXPECT_NEAR(slow.Along(held).back(), fast.Along(Path(corners, 2)).back(), 1e-12);
}

TEST(Backlash, ForgetsAtPowerOn) {
  Bench bench("gyro.backlash", Play(5));
  bench.Along(Path({20, 60}, 1));
  bench.PowerOn();
  EXPECT_NEAR(bench.At(60)[1], 0.035, 1e-12);
}

TEST(Hysteresis, IsTheSumOfItsPlaysAndMinorLoopsAreCongruent) {
  const TermParameters four = {{"dps_per_40k_at_1k", {0, 0.01, 0}},
                               {"dps_per_40k_at_2k5", {0, 0.02, 0}},
                               {"dps_per_40k_at_6k", {0, 0.03, 0}},
                               {"dps_per_40k_at_15k", {0, 0.04, 0}}};
  Bench all("gyro.hysteresis", four);
  const std::vector<double> path = Path({20, 60, 35, 50, 40, 50}, 0.5);
  const std::vector<double> sum = all.Along(path);
  std::vector<double> by_hand(path.size());
  const std::vector<std::pair<double, double>> plays = {{1, 1}, {2.5, 2}, {6, 3}, {15, 4}};
  for (const auto& [width_k, weight] : plays) {
    Bench one("gyro.backlash", Play(width_k));
    const std::vector<double> part = one.Along(path);
    for (std::size_t i = 0; i < path.size(); ++i) by_hand[i] += weight / 4 * part[i];
  }
  for (std::size_t i = 0; i < path.size(); ++i) ASSERT_NEAR(sum[i], by_hand[i], 1e-12) << i;
  // The same excursion 40-50-40 from either branch of the large loop has the same height.
  const auto height = [&](const std::vector<double>& before) {
    Bench bench("gyro.hysteresis", four);
    bench.Along(Path(before, 0.5));
    const double low = bench.Along(Path({40, 50, 40}, 0.5)).back();
    return bench.Along(Path({40, 50}, 0.5)).back() - low;
  };
  EXPECT_NEAR(height({0, 80, 40}), height({80, 0, 40}), 1e-12);
}

TEST(TemperatureRate, IsTheDiesSlopeTimesItsCoefficient) {
  Bench bench("gyro.temperature_rate", {{"dps_per_k_per_s", {0.1, -0.2, 0.3}}});
  const Axes rate_dps = bench.At(30, {}, 0.25);
  EXPECT_NEAR(rate_dps[0], 0.025, 1e-15);
  EXPECT_NEAR(rate_dps[1], -0.05, 1e-15);
  EXPECT_EQ(bench.At(30, {}, 0)[2], 0);
}

TEST(TemperatureRate, InTheRigItIsTheSlopeThatThePackageHas) {
  Model model;
  model.gyro = GyroModel{25, 0, 0, {}};
  model.terms = {"gyro.temperature_rate"};
  model.term["gyro.temperature_rate"]["dps_per_k_per_s"] = {1, 1, 1};
  RigModel rig = RigModel::Make(model, 10, 1).value();
  Inputs inputs;
  inputs.drive_pct = 70;
  const auto slope = [&] {  // tau T_d' = T_b - T_d
    return (rig.temperatures().board_degc - rig.temperatures().die_degc) / 4;
  };
  for (int i = 0; i < 300; ++i) {
    const double before = slope();
    rig.AdvanceHeat(0.1, inputs);
    EXPECT_NEAR(rig.SampleSensors(inputs).rate_dps[0], (before + slope()) / 2, 2e-5) << i;
  }
  EXPECT_GT(slope(), 0.2);
}

TEST(Creep, DecaysInAHoldWithTheSignOfTheLastStep) {
  Bench bench("gyro.creep", {{"dps_per_40k", {0, 0.02, 0}}, {"tau_s", {200}}});
  EXPECT_EQ(bench.At(20)[1], 0);
  for (const double step_k : {40.0, -40.0}) {
    const double to_degc = step_k > 0 ? 60 : 20;
    const std::vector<double> hold = bench.Along(std::vector<double>(4000, to_degc));
    for (const int t_s : {1, 100, 200, 600}) {
      EXPECT_NEAR(hold[static_cast<std::size_t>(t_s - 1)],
                  0.02 * step_k / 40 * std::exp(-t_s / 200.0), 1e-10);
    }
    EXPECT_NEAR(hold.back(), 0, 1e-9);
  }
}

TEST(Creep, IsAbsentFromTheDiesTemperature) {
  Model with;
  with.terms = {"gyro.creep"};
  RigModel a = RigModel::Make(with, 10, 1).value(), b = RigModel::Make({}, 10, 1).value();
  Inputs inputs;
  inputs.drive_pct = 80;
  for (int i = 0; i < 1000; ++i) {
    a.AdvanceHeat(0.1, inputs);
    b.AdvanceHeat(0.1, inputs);
    a.SampleSensors(inputs);
    ASSERT_EQ(a.shown_temperatures().die_degc, b.shown_temperatures().die_degc);
  }
  EXPECT_GT(std::fabs(a.TrueZro()[0] - b.TrueZro()[0]), 0.001);
}

TEST(WarmUp, RestartsAtEveryPowerOnAndFallsByEInTau) {
  Bench bench("gyro.warm_up", {{"dps", {0, 0.05, 0}}, {"tau_s", {100}}});
  for (int power_on = 0; power_on < 2; ++power_on) {
    const std::vector<double> rate_dps = bench.Along(std::vector<double>(500, 25.0));
    EXPECT_NEAR(rate_dps[0], 0.05 * std::exp(-0.01), 1e-12);
    EXPECT_NEAR(rate_dps[99] / 0.05, std::exp(-1), 1e-12);
    bench.PowerOn();
  }
}

TEST(Supply, MovesWithTheVoltsBesideItsNominal) {
  Bench bench("gyro.supply", {{"dps_per_v", {0.01, -0.02, 0}}});
  Inputs inputs;
  EXPECT_EQ(bench.At(25, inputs)[0], 0);
  inputs.supply_v = 3.0;
  EXPECT_NEAR(bench.At(25, inputs)[0], -0.003, 1e-12);
  EXPECT_NEAR(bench.At(25, inputs)[1], 0.006, 1e-12);
}

TEST(TemperatureCurve, IsAQuarticAndAKinkAndHasNoLoop) {
  Bench bench("gyro.temperature_curve",
              {{"dps_quartic", {0.016, 0, 0}}, {"dps_per_k", {0, 0.001, 0}}, {"kink_degc", {42}}});
  EXPECT_NEAR(bench.At(45)[0], 0.016 / 16, 1e-15);
  EXPECT_NEAR(bench.At(5)[0], 0.016 / 16, 1e-15);
  EXPECT_EQ(bench.At(41.9)[1], 0);
  EXPECT_NEAR(bench.At(52)[1], 0.010, 1e-12);
  bench.Along(Path({52, 80, -20, 52}, 1));
  EXPECT_NEAR(bench.At(52)[1], 0.010, 1e-12);
}

TEST(Step, JumpsOnceAndAPowerCycleDoesNotUndoIt) {
  Bench bench("gyro.step", {{"dps", {0, 0.01, 0}}, {"when_s", {30}}});
  const std::vector<double> rate_dps = bench.Along(std::vector<double>(60, 25.0));
  EXPECT_EQ(rate_dps[28], 0);
  EXPECT_EQ(rate_dps[29], 0.01);
  EXPECT_EQ(rate_dps[59], 0.01);
  bench.PowerOn();
  EXPECT_EQ(bench.At(25)[1], 0.01);
}

TEST(GSensitivity, IsTheMatrixTimesWhatTheAccelerometerFeels) {
  Bench bench("gyro.g_sensitivity", {{"dps_per_g_from_x", {1, 2, 3}},
                                     {"dps_per_g_from_y", {10, 20, 30}},
                                     {"dps_per_g_from_z", {100, 200, 300}}});
  Inputs inputs;
  inputs.gravity_g = {0, 0.6, 0.8};
  inputs.shake_g = {0.5, 0, -0.1};
  const Axes rate_dps = bench.At(25, inputs);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(rate_dps[axis], static_cast<double>(axis + 1) * (0.5 + 6 + 70), 1e-12);
  }
}

TEST(VibrationRectification, TwiceTheVibrationIsFourTimesTheShift) {
  Bench bench("gyro.vibration_rectification", {{"dps_per_g2", {0.01, 0, 0}}});
  Inputs inputs;
  EXPECT_EQ(bench.At(25, inputs)[0], 0);  // gravity alone does nothing
  double mean_dps[2] = {};
  for (int i = 0; i < 1000; ++i) {
    for (const int level : {1, 2}) {
      inputs.shake_g = {0, level * 2 * std::sin(0.37 * i), 0};
      mean_dps[level - 1] += bench.At(25, inputs)[0] / 1000;
    }
  }
  EXPECT_NEAR(mean_dps[0], 0.01 * 2, 1e-4);  // k <a^2>, a^2 / 2 of a sine of 2 g
  EXPECT_NEAR(mean_dps[1] / mean_dps[0], 4, 1e-9);
}

TEST(Quantisation, TheMeanIsAStaircaseWithoutNoiseAndStraightWithIt) {
  const auto mean_dps = [](double offset_dps, double noise_dps) {
    Model model;
    model.gyro = GyroModel{25, noise_dps / 10, 0, {{{offset_dps, 0, 0, 0}, {}, {}}}};
    model.terms = {"gyro.quantisation"};
    model.term["gyro.quantisation"]["step_dps"] = {0.1};
    RigModel rig = RigModel::Make(model, 200, 1).value();
    double sum = 0;
    for (int i = 0; i < 20000; ++i) sum += rig.SampleSensors({}).rate_dps[0] / 20000;
    EXPECT_EQ(rig.TrueZro()[0], offset_dps);
    return sum;
  };
  EXPECT_NEAR(mean_dps(0.33, 0.001), 0.3, 1e-9);
  EXPECT_NEAR(mean_dps(0.36, 0.001), 0.4, 1e-9);
  EXPECT_NEAR(mean_dps(0.33, 0.1), 0.33, 0.003);  // dithered
}

}  // namespace
}  // namespace zrobench::physics
