// What comes late: the drive, and what the sensors of plate and die show.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "rig/physics/heat_model.h"
#include "rig/physics/term.h"
#include "rig/physics/terms/delay_line.h"

namespace zrobench::physics {
namespace {

Model With(const std::string& id, TermParameters parameters) {
  Model model;
  model.terms = {id};
  model.term[id] = std::move(parameters);
  EXPECT_TRUE(FindErrors(model).empty());
  return model;
}

/// Changes every half second at most, as a controller does.
double Drive(double t_s) {
  const double k = std::floor(t_s / 0.5 + 1e-6);
  return k < 0 ? 0 : 80 * std::sin(0.3 * k);
}

std::vector<double> PlateAlong(const Model& model, double dt_s, double late_s) {
  HeatModel heat(model);
  std::vector<double> plate_degc;
  for (int i = 0; i < std::lround(200 / dt_s); ++i) {
    Inputs inputs;
    inputs.drive_pct = Drive(i * dt_s - late_s);
    heat.Advance(dt_s, inputs);
    plate_degc.push_back(heat.temperatures().plate_degc);
  }
  return plate_degc;
}

TEST(DeadTime, ShiftsTheDriveByExactlyItself) {
  for (const double dt_s : {0.005, 0.1, 0.5}) {
    for (const double late_s : {0.5, 2.0, 10.0}) {
      const auto late = PlateAlong(With("thermal.dead_time", {{"dead_time_s", {late_s}}}), dt_s, 0);
      const auto shifted = PlateAlong({}, dt_s, late_s);
      for (std::size_t i = 0; i < late.size(); ++i) {
        ASSERT_NEAR(late[i], shifted[i], 1e-9) << dt_s << " s, late " << late_s << ", step " << i;
      }
    }
  }
}

TEST(DeadTime, OfAPartOfAStepIsThatPartOfItsHeat) {
  HeatModel heat(With("thermal.dead_time", {{"dead_time_s", {1.25}}}));
  const std::vector<double> drive_pct = {0, 0, 100, 0, 0, 0, 0};
  std::vector<double> heat_w;
  for (const double drive : drive_pct) {
    Inputs inputs;
    inputs.drive_pct = drive;
    const double before_j = heat.StoredHeat();
    heat.Advance(1, inputs);
    heat_w.push_back(heat.StoredHeat() - before_j);
  }
  EXPECT_EQ(heat_w[2], 0);
  EXPECT_NEAR(heat_w[3], 75, 0.1);
  EXPECT_NEAR(heat_w[4], 25, 0.3);
  EXPECT_NEAR(heat_w[5], -0.12, 0.02);  // 100 J lost at 0.3 W/K out of 246 J/K
}

TEST(DeadTime, LongerThanItsMemoryOfStepsKeepsTimeWithinAPiece) {
  std::vector<double> states(DelayLine::kStates);
  DelayLine line(states);
  double delayed = 0, exact = 0;
  for (int i = 0; i < 4000; ++i) {  // 30 s in steps of 0.1 s: pieces of 30 / 44 s
    const auto signal = [](int k) { return std::sin(0.01 * std::max(k, 0)); };
    line.AppendHeld(signal(i), 0.1, 30);
    const double mean = line.MeanOfStep(0.1, 30);
    EXPECT_NEAR(mean, signal(i - 300), 0.01 * 30 / 44 * 10 * 1.01);
    delayed += mean;
    exact += signal(i - 300);
  }
  EXPECT_NEAR(delayed, exact, 1);
}

TEST(PlateSensorLag, OnARampIsLateByItselfAndBoardAndDieAreNot) {
  const TermInfo& info = *FindTerm("thermal.plate_sensor_lag");
  std::vector<double> states(info.states);
  info.term->Place({20, 20, 20}, states);
  const std::vector<double> lag_s = {5};
  for (const double dt_s : {0.1, 1.0}) {
    info.term->Place({20, 20, 20}, states);
    for (int i = 1; i <= 60; ++i) {
      const double t_s = i * dt_s, plate_degc = 20 + 0.2 * t_s;
      Temperatures shown = {plate_degc, 31, 32};
      info.term->Show({{}, {}, shown, dt_s}, lag_s, states, shown);
      EXPECT_NEAR(shown.plate_degc, plate_degc - 0.2 * 5 * (1 - std::exp(-t_s / 5)), 1e-10);
      EXPECT_EQ(shown.board_degc, 31);
      EXPECT_EQ(shown.die_degc, 32);
    }
  }
}

TEST(PlateSensorLag, ASmallOneShowsInProportion) {
  const TermInfo& info = *FindTerm("thermal.plate_sensor_lag");
  std::vector<double> states(info.states);
  info.term->Place({20, 20, 20}, states);
  const std::vector<double> lag_s = {1e-4};
  Temperatures shown = {22, 20, 20};
  info.term->Show({{}, {}, shown, 1}, lag_s, states, shown);
  EXPECT_NEAR((22 - shown.plate_degc) / 1e-4, 2, 1e-6);  // K/s
}

TEST(PlateSensorGain, ReadsInItsOwnScale) {
  HeatModel heat(With("thermal.plate_sensor_gain", {{"gain", {0.02}}, {"offset_k", {-0.5}}}));
  heat.Place({60, 60, 60});
  heat.Advance(1e-6, {});
  EXPECT_NEAR(heat.shown().plate_degc, 60 * 1.02 - 0.5, 1e-5);
  EXPECT_NEAR(heat.shown().die_degc, 60, 1e-5);
  EXPECT_NEAR(heat.temperatures().plate_degc, 60, 1e-5);
}

TEST(Holds, RepeatWhatTheyReadAtTheirMultiples) {
  const std::vector<std::string> ids = {"thermal.die_sensor_hold", "time.sample_hold"};
  for (const std::string& id : ids) {
    const bool of_die = id == ids[0];
    HeatModel heat(With(id, {{"hold_s", {1.28}}})), base({});
    Inputs inputs;
    inputs.drive_pct = 80;
    double held_degc = 23, last_degc = 23, behind = 0, moved = 0;
    for (int i = 1; i <= 12800; ++i) {
      heat.Advance(0.01, inputs);
      base.Advance(0.01, inputs);
      const auto pick = [&](const Temperatures& t) { return of_die ? t.die_degc : t.plate_degc; };
      if (i % 128 == 0) held_degc = pick(base.shown());
      ASSERT_NEAR(pick(heat.shown()), held_degc, 1e-12) << id << ", step " << i;
      ASSERT_EQ(of_die ? heat.shown().plate_degc : heat.shown().die_degc,
                of_die ? base.shown().plate_degc : base.shown().die_degc);
      const double k_per_s = (pick(base.shown()) - last_degc) / 0.01;
      last_degc = pick(base.shown());
      behind += (last_degc - pick(heat.shown())) * k_per_s;
      moved += k_per_s * k_per_s;
    }
    EXPECT_NEAR(behind / moved, 1.28 / 2, 0.02) << id << ": how late it is [s], in the mean";
  }
}

TEST(Holds, AReadingBetweenTwoStepsIsOfItsOwnInstant) {
  const TermInfo& info = *FindTerm("thermal.die_sensor_hold");
  for (const double hold_s : {0.064, 0.7, 1.28, 7.3}) {
    std::vector<double> states(info.states);
    info.term->Place({0, 0, 20}, states);
    for (int t_s = 1; t_s <= 50; ++t_s) {
      Temperatures shown = {0, 0, 20 + 0.5 * t_s};
      info.term->Show({{}, {}, shown, 1}, std::vector<double>{hold_s}, states, shown);
      const double read_s = hold_s * std::floor(t_s / hold_s + 1e-9);
      ASSERT_NEAR(shown.die_degc, 20 + 0.5 * read_s, 1e-9) << hold_s << " s, at " << t_s;
    }
  }
}

TEST(Latency, TheDiesTemperatureIsLateAndThePlatesIsNot) {
  for (const double dt_s : {0.1, 1.0}) {
    HeatModel heat(With("time.latency", {{"latency_s", {4}}}));
    std::vector<double> die_degc = {heat.temperatures().die_degc};
    for (int i = 1; i < 300; ++i) {
      Inputs inputs;
      inputs.drive_pct = i < 150 ? 100 : -50;
      heat.Advance(dt_s, inputs);
      die_degc.push_back(heat.temperatures().die_degc);
      const auto then = static_cast<std::size_t>(std::max(0L, i - std::lround(4 / dt_s)));
      // At 0.1 s pieces of the past are as long as the step: nothing is lost.
      ASSERT_NEAR(heat.shown().die_degc, die_degc[then], 1e-9) << dt_s << " s, step " << i;
      ASSERT_EQ(heat.shown().plate_degc, heat.temperatures().plate_degc);
    }
  }
}

TEST(Latency, BetweenTwoStepsIsInterpolated) {
  const TermInfo& info = *FindTerm("time.latency");
  std::vector<double> states(info.states);
  info.term->Place({0, 0, 20}, states);
  const std::vector<double> latency_s = {1.75};
  double shown_degc = 0;
  for (int i = 1; i <= 100; ++i) {
    Temperatures shown = {0, 0, 20 + 0.5 * i};
    info.term->Show({{}, {}, shown, 1}, latency_s, states, shown);
    shown_degc = shown.die_degc;
  }
  EXPECT_NEAR(shown_degc, 20 + 0.5 * (100 - 1.75), 1e-9);
}

}  // namespace
}  // namespace zrobench::physics
