#include "rig/physics/thermal_network.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace zrobench::physics {
namespace {

/// The base equations written out, for comparison.
std::array<double, 3> Slope(const Model& m, const std::array<double, 3>& t, const HeatFlows& q) {
  const double between = m.board->to_plate_w_per_k * (t[0] - t[1]);
  return {(q.plate_w - m.plate.to_ambient_w_per_k * (t[0] - m.ambient_degc) - between) /
              m.plate.heat_capacity_j_per_k,
          (q.board_w + between - m.board->to_ambient_w_per_k * (t[1] - m.ambient_degc)) /
              m.board->heat_capacity_j_per_k,
          (t[1] - t[2]) / m.package->time_constant_s};
}

std::array<double, 3> Moved(std::array<double, 3> t, const std::array<double, 3>& k, double by) {
  for (std::size_t i = 0; i < 3; ++i) t[i] += by * k[i];
  return t;
}

std::array<double, 3> RungeKutta(const Model& m, const HeatFlows& q, double dt_s, int steps) {
  std::array<double, 3> t{m.ambient_degc, m.ambient_degc, m.ambient_degc};
  const double h = dt_s / steps;
  for (int n = 0; n < steps; ++n) {
    const auto k1 = Slope(m, t, q);
    const auto k2 = Slope(m, Moved(t, k1, h / 2), q);
    const auto k3 = Slope(m, Moved(t, k2, h / 2), q);
    const auto k4 = Slope(m, Moved(t, k3, h), q);
    for (std::size_t i = 0; i < 3; ++i) t[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return t;
}

TEST(ThermalNetwork, AgreesWithFineRungeKutta) {
  const Model model;
  const HeatFlows heat{60, 0.4};
  ThermalNetwork network(model);
  network.Advance(90, heat);
  const auto t = RungeKutta(model, heat, 90, 9000);
  EXPECT_NEAR(network.temperatures().plate_degc, t[0], 1e-9);
  EXPECT_NEAR(network.temperatures().board_degc, t[1], 1e-9);
  EXPECT_NEAR(network.temperatures().die_degc, t[2], 1e-9);
}

TEST(ThermalNetwork, OneLongStepEqualsManyShortOnes) {
  const Model model;
  ThermalNetwork once(model), often(model);
  once.Advance(600, {80, 0.1});
  for (int i = 0; i < 600 * 200; ++i) often.Advance(1.0 / 200, {80, 0.1});
  EXPECT_NEAR(once.temperatures().plate_degc, often.temperatures().plate_degc, 1e-8);
  EXPECT_NEAR(once.temperatures().die_degc, often.temperatures().die_degc, 1e-8);
}

TEST(ThermalNetwork, MoreStepLengthsThanItKeepsStayRight) {
  const Model model;
  ThermalNetwork whole(model), pieces(model);
  double total_s = 0;
  for (int round = 0; round < 3; ++round) {
    for (int i = 1; i <= 20; ++i) {
      pieces.Advance(0.1 * i, {50, 0});
      total_s += 0.1 * i;
    }
  }
  whole.Advance(total_s, {50, 0});
  EXPECT_NEAR(pieces.temperatures().plate_degc, whole.temperatures().plate_degc, 1e-10);
  EXPECT_NEAR(pieces.temperatures().die_degc, whole.temperatures().die_degc, 1e-10);
}

TEST(ThermalNetwork, StoredHeatIsTheIntegralOfNetFlow) {
  ThermalNetwork network{Model{}};
  const std::array<HeatFlows, 4> inputs = {{{100, 0}, {-60, 0.5}, {0, 2}, {30, 0}}};
  // Gauss-Legendre, three points: exact to the sixth power of a step of 1/20 time constant.
  const double outer = 0.5 - std::sqrt(0.15);
  const std::array<double, 4> waits = {outer, 0.5 - outer, 0.5 - outer, outer};
  const std::array<double, 3> weights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double flowed_j = 0, moved_j = 0;
  for (const HeatFlows& heat : inputs) {
    for (int step = 0; step < 2000; ++step) {
      for (std::size_t i = 0; i < 4; ++i) {
        network.Advance(0.2 * waits[i], heat);
        if (i == 3) break;
        flowed_j += 0.2 * weights[i] * network.NetHeatFlow(heat);
        moved_j += 0.2 * weights[i] * std::fabs(network.NetHeatFlow(heat));
      }
    }
    EXPECT_NEAR(network.StoredHeat(), flowed_j, 1e-9 * moved_j);
  }
  EXPECT_GT(moved_j, 10000);
}

TEST(ThermalNetwork, SteadyStateByHand) {
  Model model;
  model.board->to_ambient_w_per_k = 0.2;
  ThermalNetwork network(model);
  const double plate_w = 20, board_w = 1;
  network.Advance(1e6, {plate_w, board_w});
  // Two nodes: the board's balance gives it as a mix of plate and ambient.
  const double g_pb = 0.8, g_ba = 0.2, g_pa = 0.3;
  const double plate_k =
      (plate_w + board_w * g_pb / (g_pb + g_ba)) / (g_pa + g_pb * g_ba / (g_pb + g_ba));
  const double board_k = (g_pb * plate_k + board_w) / (g_pb + g_ba);
  const Temperatures t = network.temperatures();
  EXPECT_NEAR(t.plate_degc, model.ambient_degc + plate_k, 1e-8);
  EXPECT_NEAR(t.board_degc, model.ambient_degc + board_k, 1e-8);
  EXPECT_NEAR(t.die_degc, t.board_degc, 1e-8);
  EXPECT_NEAR(network.NetHeatFlow({plate_w, board_w}), 0, 1e-8);
}

TEST(ThermalNetwork, PlateAloneHasItsTimeConstant) {
  Model model;
  model.board.reset();
  model.package.reset();
  ThermalNetwork network(model);
  const double tau_s = 240 / 0.3;
  network.Advance(tau_s, {30, 0});
  const double expected = model.ambient_degc + 100 * (1 - std::exp(-1));
  EXPECT_NEAR(network.temperatures().plate_degc, expected, 1e-9);
  EXPECT_EQ(network.temperatures().board_degc, network.temperatures().plate_degc);
  EXPECT_EQ(network.temperatures().die_degc, network.temperatures().plate_degc);
}

TEST(ThermalNetwork, WithoutABoardItsLoadHeatsThePlateAndThePackageFollowsThePlate) {
  Model model;
  model.board.reset();
  ThermalNetwork network(model);
  network.Advance(1e5, {0, 3});
  EXPECT_NEAR(network.temperatures().plate_degc, model.ambient_degc + 10, 1e-8);
  EXPECT_NEAR(network.temperatures().die_degc, model.ambient_degc + 10, 1e-8);
  EXPECT_NEAR(network.StoredHeat(), 2400, 1e-6);
}

TEST(ThermalNetwork, DieFollowsTheBoardWithItsTimeConstant) {
  Model model;
  model.board->to_plate_w_per_k = 0;  // the board alone, warming evenly
  model.board->to_ambient_w_per_k = 0;
  ThermalNetwork network(model);
  network.Advance(200, {0, 0.6});  // 0.1 K/s for 50 time constants: the lag is rate times tau
  const Temperatures t = network.temperatures();
  EXPECT_NEAR(t.board_degc, model.ambient_degc + 20, 1e-9);
  EXPECT_NEAR(t.board_degc - t.die_degc, 0.1 * model.package->time_constant_s, 1e-9);
}

TEST(ThermalNetwork, PlacedNodesGoOnFromThere) {
  Model model;
  ThermalNetwork network(model);
  network.Place({50, 40, 30});
  EXPECT_EQ(network.temperatures().plate_degc, 50);
  EXPECT_EQ(network.temperatures().die_degc, 30);
  network.Advance(1e-3, {});
  const double expected_degc = 30 + 1e-3 * (40 - 30) / model.package->time_constant_s;
  EXPECT_NEAR(network.temperatures().die_degc, expected_degc, 1e-6);
  network.Place({50, 40, 30});
  network.Advance(1e-3, {0, 0, 2});
  EXPECT_NEAR(network.temperatures().die_degc, expected_degc + 2e-3, 1e-6);
}

TEST(ThermalNetwork, ResponsesToHeatAdd) {
  const Model model;
  ThermalNetwork plate(model), board(model), both(model);
  for (const double dt_s : {5.0, 120.0, 0.7}) {
    plate.Advance(dt_s, {40, 0});
    board.Advance(dt_s, {0, 0.8});
    both.Advance(dt_s, {40, 0.8});
  }
  EXPECT_NEAR(
      both.temperatures().die_degc - model.ambient_degc,
      plate.temperatures().die_degc + board.temperatures().die_degc - 2 * model.ambient_degc,
      1e-10);
}

TEST(ThermalNetwork, ActuatorSaturatesAndHeatsAndCoolsDifferently) {
  const ThermalNetwork network{Model{}};
  EXPECT_DOUBLE_EQ(network.PlateHeat(50), 50);
  EXPECT_DOUBLE_EQ(network.PlateHeat(-50), -30);
  EXPECT_DOUBLE_EQ(network.PlateHeat(250), 100);
  EXPECT_DOUBLE_EQ(network.PlateHeat(-250), -60);
  EXPECT_EQ(network.PlateHeat(0), 0);
}

TEST(ThermalNetwork, AtAmbientNothingMoves) {
  Model model;
  model.ambient_degc = 23.1;
  ThermalNetwork network(model);
  for (int i = 0; i < 1000; ++i) network.Advance(0.37, {});
  EXPECT_EQ(network.temperatures().plate_degc, 23.1);
  EXPECT_EQ(network.temperatures().die_degc, 23.1);
}

}  // namespace
}  // namespace zrobench::physics
