#include "rig/physics/term.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace zrobench::physics {
namespace {

using testing::ElementsAre;

const std::set<std::string_view> kFamilies = {"thermal", "gyro", "acoustic", "time", "bus"};

TEST(Catalogue, EveryEntryIsComplete) {
  std::set<std::string_view> ids;
  for (const TermInfo& info : Catalogue()) {
    EXPECT_TRUE(ids.insert(info.id).second) << info.id << " twice";
    EXPECT_TRUE(kFamilies.contains(info.id.substr(0, info.id.find('.')))) << info.id;
    EXPECT_NE(info.term, nullptr);
    for (const auto text : {info.sentence, info.equation, info.source, info.excitation}) {
      EXPECT_FALSE(text.empty()) << info.id;
    }
    EXPECT_FALSE(info.channels.empty()) << info.id;
    EXPECT_FALSE(info.lookalikes.empty()) << info.id;
    EXPECT_FALSE(info.needs.empty()) << info.id;
    bool has_coefficient = false;
    for (const ParameterInfo& parameter : info.parameters) {
      EXPECT_TRUE(parameter.defaults.size() == 1 || parameter.defaults.size() == 3);
      EXPECT_FALSE(parameter.unit.empty() || parameter.sign.empty()) << parameter.name;
      EXPECT_GT(parameter.typical, 0) << parameter.name;
      has_coefficient |= parameter.coefficient;
    }
    EXPECT_TRUE(has_coefficient) << info.id;
    EXPECT_TRUE(info.borrows.empty() || FindTerm(info.borrows)) << info.id;
  }
}

TEST(Catalogue, SpeaksOfColumnsAndOfTermsThatExist) {
  const std::set<std::string> columns = {
      "t_s",        "setpoint_degc", "plate_degc", "drive_pct",   "ambient_degc", "imu_degc",
      "gyro_x_dps", "gyro_y_dps",    "gyro_z_dps", "accel_x_g",   "accel_y_g",    "accel_z_g",
      "supply_v",   "tone_hz",       "tone_v",     "tone_spl_db", "imu_time_us",  "seq"};
  for (const TermInfo& info : Catalogue()) {
    for (const std::string_view channel : info.channels) {
      EXPECT_TRUE(columns.contains(std::string(channel))) << info.id << ": " << channel;
    }
    EXPECT_TRUE(UnmetNeeds(info, std::vector(columns.begin(), columns.end())).empty()) << info.id;
    for (const std::string_view lookalike : info.lookalikes) {
      EXPECT_NE(lookalike, info.id);
      if (lookalike.find('.') != lookalike.npos) {
        EXPECT_NE(FindTerm(lookalike), nullptr) << info.id << ": " << lookalike;
      }
    }
  }
}

TEST(Catalogue, FindsByExactIdOnly) {
  EXPECT_EQ(FindTerm("acoustic.resonance")->id, "acoustic.resonance");
  EXPECT_EQ(FindTerm("acoustic.resonanc"), nullptr);
  EXPECT_EQ(NearestTerm("acoustic.resonanc"), "acoustic.resonance");
  EXPECT_EQ(NearestTerm("rectification"), "acoustic.rectification");
}

TEST(UnmetNeeds, OneOfTheAlternativesIsEnough) {
  TermInfo info;
  info.needs = {"imu_degc", "plate_degc|drive_pct", "tone_hz"};
  const std::vector<std::string> columns = {"t_s", "drive_pct", "imu_degc"};
  EXPECT_THAT(UnmetNeeds(info, columns), ElementsAre("tone_hz"));
  EXPECT_THAT(UnmetNeeds(info, std::vector<std::string>{"plate"}),
              ElementsAre("imu_degc", "plate_degc|drive_pct", "tone_hz"));
}

TEST(FlatParameters, StatedValuesReplaceDefaultsAndBorrowedOnesFollow) {
  Model model;
  model.term["acoustic.resonance"]["q"] = {900};
  model.term["acoustic.rectification"]["dps_per_pa2"] = {1, 2, 3};
  EXPECT_THAT(FlatParameters(*FindTerm("acoustic.rectification"), model),
              ElementsAre(1, 2, 3, 33000, 30000, 27000, 900, 1373, 0.06, 0.08, 0.15));
}

TEST(ActiveTerms, HoldsWhatIsListedInItsOrderAndNothingElse) {
  Model model;
  model.term["acoustic.resonance"]["q"] = {900};  // stated, but not listed
  EXPECT_TRUE(ActiveTerms(model).empty());
  model.terms = {"acoustic.resonance", "acoustic.rectification"};
  const auto both = ActiveTerms(model);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].info->id, "acoustic.resonance");
  EXPECT_EQ(both[0].first_state, 0u);
  EXPECT_EQ(both[1].info->id, "acoustic.rectification");
  EXPECT_EQ(both[1].first_state, both[0].info->states);
}

TEST(Term, RunsFromFlatVectorsSoThatAFiniteDifferenceIsItsCoefficient) {
  const TermInfo& info = *FindTerm("acoustic.rectification");
  const std::vector<double> parameters = FlatParameters(info, Model{});
  Inputs inputs;
  inputs.tone_hz = 27000;
  inputs.tone_pa = 2;
  const auto rate_z = [&](double coefficient) {
    std::vector<double> moved = parameters;
    moved[2] = coefficient;
    Sensed sensed;
    info.term->Output({inputs, {}, 0.005, {}}, moved, {}, sensed);
    return sensed.rate_dps[2];
  };
  EXPECT_NEAR((rate_z(0.076) - rate_z(0.074)) / 0.002, 4, 1e-9);  // p^2 at resonance
}

TEST(Ageing, ANewPartIsUntouchedAndAnOldOneHasMovedByDecadesAndYears) {
  Model model;
  model.terms = {"gyro.ageing"};
  model.term["gyro.ageing"]["dps_per_decade"] = {0.003, 0, 0};
  model.term["gyro.ageing"]["dps_per_year"] = {0, 0.2, -0.1};
  RigModel rig = RigModel::Make(model, 200, 1).value();
  const auto zro_dps = [&](double age_days) {
    Inputs inputs;
    inputs.age_days = age_days;
    rig.AdvanceHeat(0.1, inputs);  // at ambient: it stays there
    return rig.TrueZro();
  };
  const Axes fresh = zro_dps(0), old = zro_dps(99), year = zro_dps(365.25);
  EXPECT_NEAR(old[0] - fresh[0], 0.006, 1e-9);  // 1 + 99 / onset of 1 day: two decades
  EXPECT_NEAR(year[1] - fresh[1], 0.2, 1e-9);
  EXPECT_NEAR(year[2] - fresh[2], -0.1, 1e-9);
}

TEST(SelfHeating, TheBoardsWorkWarmsTheDieAboveThePlateByWattsOverConductance) {
  Model model;
  model.terms = {"thermal.self_heating"};
  model.term["thermal.self_heating"]["idle_w"] = {0.2};
  model.term["thermal.self_heating"]["full_load_w"] = {4};
  model.plate.heat_capacity_j_per_k = 1e6;  // holds whatever the board does
  model.board->to_ambient_w_per_k = 0;
  RigModel rig = RigModel::Make(model, 200, 1).value();
  const auto rise_k = [&](double load_pct, bool powered) {
    Inputs inputs;
    inputs.load_pct = load_pct;
    inputs.powered = powered;
    rig.AdvanceHeat(300, inputs);
    return rig.temperatures().die_degc - rig.temperatures().plate_degc;
  };
  EXPECT_NEAR(rise_k(0, true), 0.2 / 0.8, 1e-3);
  EXPECT_NEAR(rise_k(50, true), 2.2 / 0.8, 1e-3);
  EXPECT_NEAR(rise_k(100, true), 4.2 / 0.8, 1e-3);
  EXPECT_NEAR(rise_k(100, false), 0, 1e-3);
}

TEST(SelfHeating, IsOffUnlessListed) {
  RigModel rig = RigModel::Make(Model{}, 200, 1).value();
  Inputs inputs;
  inputs.load_pct = 100;
  rig.AdvanceHeat(300, inputs);
  EXPECT_EQ(rig.temperatures().die_degc, 23);
}

}  // namespace
}  // namespace zrobench::physics
