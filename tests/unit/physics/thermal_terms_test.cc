// Each effect on heat against its law: the equations integrated by hand in small steps, and what
// follows from them in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "rig/physics/heat_model.h"
#include "rig/physics/term.h"

namespace zrobench::physics {
namespace {

Model With(const std::string& id, TermParameters parameters) {
  Model model;
  model.terms = {id};
  model.term[id] = std::move(parameters);
  EXPECT_TRUE(FindErrors(model).empty());
  return model;
}

double Drive(double t_s) {
  if (t_s < 150) return 100;
  return t_s < 300 ? -100 : 40;
}

/// Plate, board, die, and one mass more.
using State = std::array<double, 4>;
/// Adds an effect to the base equations' rates of change [K/s].
using Effect = std::function<void(double t_s, const State& at, State& rate)>;

State BaseRate(const Model& m, double t_s, const State& at) {
  const double drive = Drive(t_s) / 100;
  const double heat_w = drive * (drive > 0 ? m.plate.heater_w : m.plate.cooler_w);
  const double across_w = m.board->to_plate_w_per_k * (at[0] - at[1]);
  const double plate_loss_w = m.plate.to_ambient_w_per_k * (at[0] - m.ambient_degc);
  const double board_loss_w = m.board->to_ambient_w_per_k * (at[1] - m.ambient_degc);
  return {(heat_w - plate_loss_w - across_w) / m.plate.heat_capacity_j_per_k,
          (across_w - board_loss_w) / m.board->heat_capacity_j_per_k,
          (at[1] - at[2]) / m.package->time_constant_s, 0};
}

/// Runge-Kutta 4 in steps of 50 ms, from ambient on.
State Integrated(const Model& m, const Effect& effect, double until_s) {
  constexpr double kStep_s = 0.05;
  State at;
  at.fill(m.ambient_degc);
  const auto rate = [&](double t_s, const State& from, const State& slope, double h) {
    State moved = from;
    for (std::size_t i = 0; i < 4; ++i) moved[i] += h * slope[i];
    State result = BaseRate(m, t_s, moved);
    effect(t_s, moved, result);
    return result;
  };
  for (int k = 0; k < std::lround(until_s / kStep_s); ++k) {
    const double t_s = k * kStep_s + 1e-9;  // within the step: its drive holds
    const double middle_s = t_s + kStep_s / 2;
    const State a = rate(t_s, at, {}, 0), b = rate(middle_s, at, a, kStep_s / 2);
    const State c = rate(middle_s, at, b, kStep_s / 2);
    const State d = rate(t_s + kStep_s - 2e-9, at, c, kStep_s);
    for (std::size_t i = 0; i < 4; ++i) at[i] += kStep_s / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return at;
}

Temperatures After(const Model& model, double until_s, double dt_s = 0.1) {
  HeatModel heat(model);
  for (int k = 0; k < std::lround(until_s / dt_s); ++k) {
    Inputs inputs;
    inputs.drive_pct = Drive(k * dt_s + 1e-9);
    heat.Advance(dt_s, inputs);
  }
  return heat.temperatures();
}

void ExpectFollows(const Model& model, const Effect& effect) {
  Model base = model;
  base.terms.clear();
  double matters_k = 0;
  for (const double until_s : {10.0, 100.0, 200.0, 320.0, 600.0}) {
    const State by_hand = Integrated(model, effect, until_s);
    const Temperatures with = After(model, until_s), without = After(base, until_s);
    EXPECT_NEAR(with.plate_degc, by_hand[0], 2e-3) << until_s;
    EXPECT_NEAR(with.board_degc, by_hand[1], 2e-3) << until_s;
    EXPECT_NEAR(with.die_degc, by_hand[2], 2e-3) << until_s;
    matters_k = std::max(matters_k, std::fabs(without.die_degc - by_hand[2]));
  }
  EXPECT_GT(matters_k, 0.1);
}

TEST(BaseModel, FollowsItsEquations) {
  const Effect none = [](double, const State&, State&) {};
  const State by_hand = Integrated({}, none, 320);
  const Temperatures t = After({}, 320);
  EXPECT_NEAR(t.plate_degc, by_hand[0], 1e-6);
  EXPECT_NEAR(t.board_degc, by_hand[1], 1e-6);
  EXPECT_NEAR(t.die_degc, by_hand[2], 1e-6);
}

TEST(ParallelMass, FollowsItsEquation) {
  ExpectFollows(With("thermal.parallel_mass", {{"w_per_k", {0.05}}, {"tau_s", {200}}}),
                [](double, const State& at, State& rate) {
                  rate[1] -= 0.05 * (at[1] - at[3]) / 6;
                  rate[3] = (at[1] - at[3]) / 200;
                });
}

TEST(ParallelMass, SharesHeatByCapacityAndLosesNone) {
  for (const bool has_board : {true, false}) {
    Model model = With("thermal.parallel_mass", {{"w_per_k", {0.5}}, {"tau_s", {100}}});
    model.plate.to_ambient_w_per_k = 0;
    model.board->to_ambient_w_per_k = 0;
    if (!has_board) model.board.reset();
    HeatModel heat(model);
    Inputs inputs;
    inputs.drive_pct = 100;
    for (int i = 0; i < 1000; ++i) heat.Advance(0.1, inputs);  // 10 kJ
    inputs.drive_pct = 0;
    for (int i = 0; i < 40000; ++i) heat.Advance(0.1, inputs);
    const double whole_j_per_k = 240 + (has_board ? 6 : 0) + 0.5 * 100;
    EXPECT_NEAR(heat.temperatures().plate_degc, 23 + 1e4 / whole_j_per_k, 1e-6) << has_board;
  }
}

TEST(ParallelMass, StaysWarmOverAPowerCycle) {
  const auto end_degc = [](bool cycled) {
    HeatModel heat(With("thermal.parallel_mass", {{"w_per_k", {0.1}}, {"tau_s", {300}}}));
    Inputs inputs;
    inputs.drive_pct = 50;
    for (int i = 0; i < 600; ++i) {
      if (cycled && i == 300) heat.PowerOn();
      heat.Advance(1, inputs);
    }
    return heat.temperatures().board_degc;
  };
  EXPECT_EQ(end_degc(true), end_degc(false));
}

TEST(ParallelMass, KeepsItsHeatWhileThePlateIsHeldAsARecordingFoundIt) {
  Model model = With("thermal.parallel_mass", {{"w_per_k", {0.2}}, {"tau_s", {300}}});
  model.board->to_ambient_w_per_k = 0;
  HeatModel heat(model);
  heat.Place({20, 20, 20});
  for (int t_s = 0; t_s < 600; ++t_s) {
    Temperatures held = heat.temperatures();
    held.plate_degc = 60;
    heat.Place(held);
    heat.Advance(1, {});
  }
  // Slow beside the board: T_b = (0.8 T_p + 0.2 T_m) / 1, T_p - T_m falls with 300 s / 0.8.
  const double behind_k = 60 - heat.temperatures().board_degc;
  EXPECT_NEAR(behind_k, 0.2 * 40 * std::exp(-600 * 0.8 / 300), 0.1);
}

TEST(SeriesMass, FollowsItsEquation) {
  ExpectFollows(With("thermal.series_mass", {{"share", {0.4}}, {"tau_s", {25}}}),
                [](double, const State& at, State& rate) {
                  rate[2] = (0.6 * at[1] + 0.4 * at[3] - at[2]) / 4;
                  rate[3] = (at[1] - at[3]) / 25;
                });
}

TEST(ContactResistance, FollowsItsEquationAndMovesHeatWithoutMakingAny) {
  const Model model = With("thermal.contact_resistance_temperature", {{"per_40k", {0.3}}});
  ExpectFollows(model, [](double, const State& at, State& rate) {
    const double more_w = 0.3 * (at[1] - 25) / 40 * 0.8 * (at[0] - at[1]);
    rate[0] -= more_w / 240;
    rate[1] += more_w / 6;
  });
}

TEST(Radiation, FollowsItsEquation) {
  ExpectFollows(With("thermal.radiation", {{"emissive_m2", {0.02}}}),
                [](double, const State& at, State& rate) {
                  const double t = at[0] + 273.15, a = 23 + 273.15;
                  rate[0] -= 0.02 * 5.670374419e-8 * (t * t * t * t - a * a * a * a) / 240;
                });
}

/// Heat that a plate at this temperature loses to ambient [W].
double Loss(const Model& model, double plate_degc) {
  HeatModel heat(model);
  heat.Place({plate_degc, plate_degc, plate_degc});
  heat.Advance(1e-6, {});
  return -heat.NetHeatFlow();
}

TEST(Radiation, IsStrongerAboveAmbientThanBelowAndConvectionIsNot) {
  const Model radiates = With("thermal.radiation", {{"emissive_m2", {0.02}}});
  const Model convects = With("thermal.convection", {{"w_per_k", {0.1}}, {"exponent", {0.25}}});
  EXPECT_GT(Loss(radiates, 83) + Loss(radiates, -37), 2);
  EXPECT_NEAR(Loss(convects, 83), -Loss(convects, -37), 1e-4);
  EXPECT_NEAR(Loss(radiates, 23), 0, 1e-6);
  EXPECT_NEAR(Loss(convects, 23), 0, 1e-6);
}

TEST(Convection, FollowsItsEquation) {
  ExpectFollows(With("thermal.convection", {{"w_per_k", {0.2}}, {"exponent", {0.33}}}),
                [](double, const State& at, State& rate) {
                  const double above = at[0] - 23;
                  rate[0] -= 0.2 * above * (std::pow(std::fabs(above) / 20, 0.33) - 1) / 240;
                });
}

TEST(AmbientDrift, FollowsItsEquation) {
  ExpectFollows(With("thermal.ambient_drift", {{"k_per_h", {6}}}),
                [](double t_s, const State&, State& rate) {
                  rate[0] += 0.3 * 6 * t_s / 3600 / 240;
                  rate[1] += 0.01 * 6 * t_s / 3600 / 6;
                });
}

TEST(PeltierJoule, FollowsItsEquation) {
  ExpectFollows(With("thermal.peltier_joule", {{"joule_w", {8}}}),
                [](double t_s, const State&, State& rate) {
                  rate[0] += 8 * std::pow(Drive(t_s) / 100, 2) / 240;
                });
}

TEST(PeltierJoule, HalfTheCurrentIsAQuarterOfTheHeatWhicheverWayItPumps) {
  const auto joule_w = [](double drive_pct) {
    Inputs inputs;
    inputs.drive_pct = drive_pct;
    HeatModel with(With("thermal.peltier_joule", {{"joule_w", {8}}})), without({});
    with.Advance(1e-6, inputs);
    without.Advance(1e-6, inputs);
    return with.NetHeatFlow() - without.NetHeatFlow();
  };
  EXPECT_NEAR(joule_w(50), 2, 1e-6);
  EXPECT_NEAR(joule_w(-50), 2, 1e-6);
  EXPECT_NEAR(joule_w(-250), 8, 1e-6);
}

TEST(PeltierJoule, IsOfTheCurrentThatFlowsNotOfTheOneAskedFor) {
  Model model = With("thermal.saturation", {{"missing_pct", {50}}});
  model.terms.push_back("thermal.peltier_joule");
  model.term["thermal.peltier_joule"]["joule_w"] = {8};
  HeatModel heat(model);
  Inputs inputs;
  inputs.drive_pct = 100;
  heat.Advance(1e-6, inputs);
  EXPECT_NEAR(heat.NetHeatFlow(), 50 + 2, 1e-4);
}

TEST(Saturation, CutsBothEndsAndNothingInBetween) {
  const Model model = With("thermal.saturation", {{"missing_pct", {30}}});
  const auto heat_w = [&](double drive_pct) {
    HeatModel heat(model);
    Inputs inputs;
    inputs.drive_pct = drive_pct;
    heat.Advance(1e-6, inputs);
    return heat.NetHeatFlow();
  };
  EXPECT_NEAR(heat_w(60), 60, 1e-4);
  EXPECT_NEAR(heat_w(70), 70, 1e-4);
  EXPECT_NEAR(heat_w(100), 70, 1e-4);
  EXPECT_NEAR(heat_w(-100), -42, 1e-4);
}

}  // namespace
}  // namespace zrobench::physics
