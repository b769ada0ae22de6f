// The generator's physics, noise, registers and measure of visibility.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <set>
#include <sstream>

#include "tests/blind/case_set.h"
#include "tests/blind/memory.h"
#include "tests/blind/pink.h"
#include "tests/blind/seal.h"

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

CaseOrder Hiding(const std::string& id, double lambda) {
  CaseOrder order;
  order.kind = "single";
  order.hide = {{id, lambda}};
  return order;
}

std::vector<std::vector<std::string>> Table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line + ",");
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST(FiniteVolumes, KeepTheHeatThatEnters) {
  Solids solids;
  solids.convection_w = 0.5;
  solids.radiation_m2 = 1e-3;
  ThermalRig rig(BaseModel{}, solids, {});
  for (int step = 0; step < 8000; ++step) rig.Step(step < 4000 ? 60 : -30, step * kSubstep_s, 0);
  const HeatAccount account = rig.account();
  EXPECT_GT(std::abs(account.stored_j), 1000);
  EXPECT_NEAR(account.stored_j, account.entered_j, 1e-6 * std::abs(account.stored_j));
}

TEST(FiniteVolumes, SettleWhereTheBaseModelDoes) {
  BaseModel model;
  ThermalRig rig(model, Solids{}, {});
  for (int step = 0; step < 60000; ++step) rig.Step(10, step * kSubstep_s, 0);
  const double through_board =
      1 / (1 / model.board_to_plate_w_per_k + 1 / model.board_to_ambient_w_per_k);
  const double above = 10 / (model.plate_to_ambient_w_per_k + through_board);
  EXPECT_NEAR(rig.plate_degc(), model.ambient_degc + above, 0.01);
  const double droop = through_board / model.board_to_plate_w_per_k;
  EXPECT_NEAR(rig.die_degc(), model.ambient_degc + above * (1 - droop), 0.02);
}

TEST(Pink, HasTheDensityAndSlopeOfFlicker) {
  constexpr int kRows = 8192;
  constexpr double kFlicker = 0.001;
  Draw draw(3, "pink");
  std::vector<double> power(3, 0.0);
  const std::vector<int> lines = {16, 128, 1024};  // cycles a record
  constexpr int kRecords = 60;
  for (int record = 0; record < kRecords; ++record) {
    const VectorXd noise = PinkNoise(draw, kRows, kFlicker);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::complex<double> sum = 0;
      for (int t = 0; t < kRows; ++t) {
        const double window = 1 - std::cos(2 * M_PI * t / kRows);  // Hann, mean square 1.5
        sum += noise[t] * window * std::polar(1.0, -2 * M_PI * lines[i] * t / kRows);
      }
      power[i] += 2 * std::norm(sum) / (1.5 * kRows) / kRecords;
    }
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double hz = static_cast<double>(lines[i]) / kRows;
    EXPECT_NEAR(power[i] * 2 * M_PI * hz / (kFlicker * kFlicker), 1, 0.45) << hz;
  }
  const double slope = std::log(power[2] / power[0]) / std::log(64.0);
  EXPECT_NEAR(slope, -1, 0.12);
}

TEST(Whitener, TakesFlickerForWhatItIs) {
  const FlickerStates states = FlickerAs(0.002);
  for (double hz = 1.0 / kRunRows; hz < 0.5 / kBlockRows; hz *= 1.3) {
    EXPECT_NEAR(DensityOf(states, hz) * 2 * M_PI * hz / 4e-6, 1, hz < 0.03 ? 0.1 : 0.11) << hz;
  }
}

TEST(Whitener, MakesKnownNoiseWhite) {
  const Bench bench = DrawBench(Draw(5, "bench"), false);
  const Index size = Index{kBlocks} * kChannels;
  const Whitener whitener(bench.actual, bench.instruments, VectorXd::Constant(size, 30), 1);
  Draw draw(5, "noise");
  double sum = 0, lagged = 0, drift = 0;
  int count = 0;
  for (int record = 0; record < 12; ++record) {
    Rows rows{VectorXd::Zero(kRunRows), VectorXd::Zero(kRunRows), Eigen::MatrixXd(kRunRows, 3)};
    for (Index axis = 0; axis < 3; ++axis) {
      rows.gyro_dps.col(axis) = PinkNoise(draw, kRunRows, bench.instruments.flicker_dps);
      for (double& value : rows.gyro_dps.col(axis)) {
        value += draw.Normal(bench.instruments.gyro_density_dps_per_rthz / std::sqrt(2.0));
      }
    }
    const Eigen::MatrixXd white = whitener.Whiten(Stack({rows}));
    for (Index block = 1; block < kBlocks; ++block) {
      const double now = white(block * kChannels + 3, 0);
      sum += now * now;
      lagged += now * white((block - 1) * kChannels + 3, 0);
      drift += now;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 1, 0.05);
  EXPECT_NEAR(lagged / count, 0, 0.05);
  EXPECT_NEAR(drift / count, 0, 0.05);
}

TEST(Relays, RememberAndStandStillInAHold) {
  VectorXd up_down(401);  // a triangle
  for (int t = 0; t <= 400; ++t) {
    up_down[t] = 20 + 20 * (t <= 200 ? t : 400 - t) / 200.0;
  }
  const VectorXd output = RelayPlane(up_down, 4);
  EXPECT_GT(output[300] - output[100], 0.05);  // the same temperature, coming down
  VectorXd hold = up_down;
  hold.tail(200).setConstant(hold[200]);
  const VectorXd held = RelayPlane(hold, 4);
  EXPECT_EQ(held[400], held[201]);
}

TEST(Relaxation, FollowsTheStretchedExponential) {
  VectorXd step = VectorXd::Ones(4000);
  step[0] = 0;
  const VectorXd left = Relaxation(step, 300, 0.7);
  for (const int t : {10, 100, 1000, 3000}) {
    EXPECT_NEAR(left[t + 1], std::exp(-std::pow(t / 300.0, 0.7)), 0.01) << t;
  }
}

TEST(Controller, ReachesItsSetPoint) {
  const Bench bench = DrawBench(Draw(8, "bench"), false);
  const std::vector<Schedule> schedules = DrawSchedules(Draw(8, "schedules"), bench);
  const Paths paths = CloseLoop(bench, schedules, {}, 8);
  int judged = 0;
  for (std::size_t run = 0; run < schedules.size(); ++run) {
    const VectorXd& wanted = schedules[run].setpoint_degc;
    for (Index row = 1200; row < kRunRows; ++row) {
      if ((wanted.segment(row - 300, 300).array() - wanted[row]).abs().maxCoeff() > 0) continue;
      EXPECT_NEAR(paths[run].plate_degc[row], wanted[row], 0.5) << run << " " << row;
      ++judged;
    }
  }
  EXPECT_GT(judged, 3000);
}

TEST(Registers, ShowWholeSteps) {
  EXPECT_NEAR(Register(21.26, 0.1), 21.3, 1e-12);
  EXPECT_NEAR(Register(-0.04, 0.1), 0, 1e-12);
  EXPECT_EQ(Register(30.06, 0.125), 30.0);
  const HiddenCase made = MakeCase(CaseOrder{}, 11);
  const auto rows = Table(RunText(made, 0, 11));
  std::set<std::string> seen;
  for (std::size_t row = 2; row < rows.size(); ++row) {
    if (rows[row][2].empty()) continue;
    const double polls = std::stod(rows[row][2]) / 0.1 * kSubsteps;  // a mean of four polls
    EXPECT_NEAR(polls, std::round(polls), 1e-3);
    seen.insert(rows[row][2]);
  }
  EXPECT_GT(seen.size(), 100U);
}

TEST(Cases, AreAsVisibleAsOrdered) {
  for (const auto& [id, lambda] : {std::pair<std::string, double>{"gyro.creep", 40},
                                   {"thermal.parallel_mass", 100},
                                   {"acoustic.harmonics", 20}}) {
    const HiddenCase made = MakeCase(Hiding(id, lambda), 21);
    EXPECT_NEAR(made.hidden[0].lambda / lambda, 1, 0.05) << id;
    EXPECT_LT(made.hidden[0].nearest.noncentrality, made.hidden[0].lambda * 1.001) << id;
    EXPECT_FALSE(made.channels.empty()) << id;
  }
}

class Effects : public testing::TestWithParam<bool> {};  // does the station know rectification?

TEST_P(Effects, ActAndVanishWithTheirStrength) {
  const Bench bench = DrawBench(Draw(6, "bench"), GetParam());
  const std::vector<Schedule> schedules = DrawSchedules(Draw(6, "schedules"), bench);
  const Campaign campaign = CampaignOf(schedules, CloseLoop(bench, schedules, {}, 6));
  const Yardstick yard(bench, campaign);
  const VectorXd without = Respond(bench.actual, Lumps(), {}, campaign);
  const auto lambda = [&](Effect effect, double strength) {
    effect.strength = strength;
    return yard.Lambda(Respond(bench.actual, Lumps(), {effect}, campaign) - without);
  };
  Draw draw(6, "effects");
  for (const auto* kinds : {&KnownKinds(), &ForeignKinds()}) {
    for (const Kind& kind : *kinds) {
      if (!yard.MaySuspect(kind)) continue;
      const Effect effect = DrawEffect(kind, draw);
      EXPECT_LT(lambda(effect, 1e-6 * kind.typical), 1e-3) << kind.id;
      EXPECT_GT(lambda(effect, kind.most), 10) << kind.id;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(RectificationKnown, Effects, testing::Bool());

TEST(Cases, HaveStructureTooSmallToName) {
  for (const std::uint64_t seed : {31U, 32U, 33U, 34U}) {
    const HiddenCase made = MakeCase(CaseOrder{}, seed);
    EXPECT_THAT(made.structural.size(), testing::AnyOf(2, 3));
    EXPECT_GT(made.structural_lambda, 0.05);
    EXPECT_LE(made.structural_lambda, 4) << seed;
    EXPECT_TRUE(made.hidden.empty());
  }
}

TEST(Cases, FollowFromTheSeedAlone) {
  const CaseOrder order = Hiding("gyro.supply", 40);
  const HiddenCase once = MakeCase(order, 41);
  const HiddenCase again = MakeCase(order, 41);
  EXPECT_EQ(LabelText(once, "case-0001"), LabelText(again, "case-0001"));
  EXPECT_EQ(RunText(once, 2, 41), RunText(again, 2, 41));
  EXPECT_NE(RunText(once, 2, 41), RunText(MakeCase(order, 42), 2, 42));
}

TEST(Cases, TellNothingByTheirForm) {
  CaseOrder null;
  null.kind = "null";
  const HiddenCase clean = MakeCase(null, 51);
  const HiddenCase hiding = MakeCase(Hiding("gyro.backlash", 400), 51);
  EXPECT_EQ(StationText(clean.bench, clean.schedules), StationText(hiding.bench, hiding.schedules));
  for (std::size_t run = 0; run < 4; ++run) {
    const auto a = Table(RunText(clean, run, 51));
    const auto b = Table(RunText(hiding, run, 51));
    ASSERT_EQ(a.size(), b.size());
    ASSERT_EQ(a.size(), std::size_t{kRunRows} + 2);
    EXPECT_EQ(a[0], b[0]);
    for (std::size_t row = 1; row < a.size(); row += 97) {
      EXPECT_EQ(a[row][0], b[row][0]);
      EXPECT_EQ(a[row][1], b[row][1]);
      EXPECT_EQ(a[row].back(), b[row].back());
    }
  }
  const std::string station = StationText(hiding.bench, hiding.schedules);
  EXPECT_THAT(station, testing::Not(testing::HasSubstr("backlash")));
}

TEST(Sets, HoldEveryClassAndEnoughNulls) {
  const std::vector<CaseOrder> full = OrdersOf("full", 1);
  EXPECT_GE(full.size(), 600U);
  std::map<std::string, int> count;
  std::set<std::string> ids;
  for (const CaseOrder& order : full) {
    ++count[order.kind.substr(0, 4)];
    for (const auto& [id, lambda] : order.hide) ids.insert(id);
  }
  EXPECT_GE(count["null"], 200);
  EXPECT_EQ(ids.size(), KnownKinds().size() + ForeignKinds().size());
  EXPECT_EQ(OrdersOf("smoke", 1).size(), 24U);
  EXPECT_THROW(OrdersOf("huge", 1), std::invalid_argument);
}

TEST(Seal, BindsLabelAndNonce) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(SealOf("ab", "c"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const std::string nonce = Nonce(Draw(1, "nonce"));
  EXPECT_EQ(nonce.size(), 64U);
  EXPECT_NE(SealOf("{\"class\": \"null\"}", nonce), SealOf("{\"class\": \"nulk\"}", nonce));
  EXPECT_NE(nonce, Nonce(Draw(2, "nonce")));
}

}  // namespace
}  // namespace zrobench::blind
