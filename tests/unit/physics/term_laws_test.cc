// What holds for every term of the catalogue.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "rig/physics/heat_model.h"
#include "rig/physics/rig_model.h"
#include "rig/physics/term.h"

namespace zrobench::physics {
namespace {

/// Terms that change what other terms do with sound show nothing on their own.
const std::vector<std::string> kHeard = {"acoustic.resonance", "acoustic.rectification"};

Model WithTerm(const TermInfo& info, double scale) {
  Model model;
  model.ambient_degc = 23;
  model.gyro->noise_density_dps_per_rthz = 0;
  model.gyro->flicker_dps = 0;
  for (auto& zro_dps : model.gyro->zro_dps) zro_dps = {0.5, 0.02, 0, 0};  // a straight line
  const std::string id(info.id);
  if (id.starts_with("acoustic.") && std::ranges::find(kHeard, id) == kHeard.end()) {
    model.terms = kHeard;
  }
  model.terms.push_back(id);
  for (const ParameterInfo& parameter : info.parameters) {
    if (!parameter.coefficient) continue;
    std::vector<double> values = parameter.defaults;
    for (double& value : values) value *= scale;
    model.term[id][std::string(parameter.name)] = values;
  }
  if (id == "gyro.step") model.term[id]["when_s"] = {90};  // within what is played
  return model;
}

Model WithoutTerm(const TermInfo& info) {
  Model model = WithTerm(info, 0);
  model.terms.pop_back();
  return model;
}

/// Everything that may excite a term, at the i-th tenth of a second.
Inputs Excitation(int i) {
  Inputs inputs;
  inputs.drive_pct = i < 400 ? 100 : (i < 900 ? 60 : -80);
  inputs.tone_hz = i < 300 ? 26998 : 13500;
  inputs.tone_pa = i % 100 < 50 ? 2 : 0;
  inputs.load_pct = 30;
  inputs.supply_v = 3.3 + 0.1 * (i % 3);
  inputs.shake_g = {0.1 * (i % 5), -0.05 * (i % 7), 0};
  inputs.age_days = 0.01 * i;
  return inputs;
}

/// All that a rig shows over two power-ons, flat.
std::vector<double> Play(const Model& model) {
  RigModel rig = RigModel::Make(model, 10, 3).value();
  std::vector<double> shown;
  for (int i = 0; i < 1500; ++i) {
    if (i == 700) rig.PowerCycle();
    const Inputs inputs = Excitation(i);
    rig.AdvanceHeat(0.1, inputs);
    const Sensed sensed = rig.SampleSensors(inputs);
    for (const double rate_dps : sensed.rate_dps) shown.push_back(rate_dps);
    for (const double rate_dps : rig.TrueZro()) shown.push_back(rate_dps);
    shown.push_back(rig.shown_temperatures().plate_degc);
    shown.push_back(rig.shown_temperatures().die_degc);
  }
  return shown;
}

std::string Name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace(name, '.', '_');
  return name;
}

std::vector<std::string> Ids(bool linear_only) {
  std::vector<std::string> ids;
  for (const TermInfo& info : Catalogue()) {
    if (!linear_only || (info.linear && !info.id.starts_with("thermal.")))
      ids.emplace_back(info.id);
  }
  return ids;
}

class EveryTerm : public testing::TestWithParam<std::string> {
 protected:
  const TermInfo& info() const { return *FindTerm(GetParam()); }
};

TEST_P(EveryTerm, WithZeroCoefficientsIsTheBaseModelBitByBit) {
  EXPECT_EQ(Play(WithTerm(info(), 0)), Play(WithoutTerm(info())));
}

TEST_P(EveryTerm, WithItsDefaultsChangesOnlyFiniteNumbersButDoesChangeThem) {
  const auto with = Play(WithTerm(info(), 1)), without = Play(WithoutTerm(info()));
  double largest = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    ASSERT_TRUE(std::isfinite(with[i])) << i;
    largest = std::max(largest, std::fabs(with[i] - without[i]));
  }
  EXPECT_GT(largest, 1e-6);
}

TEST_P(EveryTerm, TriesOnlyValuesItsModelAccepts) {
  for (const ParameterInfo& parameter : info().parameters) {
    for (const double value : parameter.grid) {
      Model model = WithTerm(info(), 1);
      model.term[GetParam()][std::string(parameter.name)] =
          std::vector<double>(parameter.defaults.size(), value);
      EXPECT_TRUE(FindErrors(model).empty()) << parameter.name << " = " << value;
    }
    // The centre of a resonance is swept for, not guessed from a list.
    if (!parameter.coefficient && parameter.name != "resonance_hz") {
      EXPECT_FALSE(parameter.grid.empty()) << parameter.name;
    }
  }
}

TEST_P(EveryTerm, RefusesAmountsAndWidthsBelowZero) {
  for (const ParameterInfo& parameter : info().parameters) {
    Model model = WithTerm(info(), 1);
    model.term[GetParam()][std::string(parameter.name)] =
        std::vector<double>(parameter.defaults.size(), -1);
    EXPECT_EQ(FindErrors(model).empty(), !parameter.positive && !parameter.not_negative)
        << parameter.name;
  }
}

TEST_P(EveryTerm, HasARowInTheFormatsWithEveryKey) {
  std::ifstream in(std::string(ZROBENCH_SOURCE_DIR) + "/docs/formats.md");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("| `" + GetParam() + "` |")) continue;
    for (const ParameterInfo& parameter : info().parameters) {
      EXPECT_NE(line.find("`" + std::string(parameter.name) + "`"), std::string::npos)
          << parameter.name;
    }
    return;
  }
  FAIL() << "docs/formats.md has no row for it";
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryTerm, testing::ValuesIn(Ids(false)), Name);

class LinearTerm : public EveryTerm {};

TEST_P(LinearTerm, IsInProportionToItsCoefficients) {
  const auto none = Play(WithTerm(info(), 0)), once = Play(WithTerm(info(), 1));
  const auto thrice = Play(WithTerm(info(), -3));
  for (std::size_t i = 0; i < none.size(); ++i) {
    ASSERT_NEAR(thrice[i] - none[i], -3 * (once[i] - none[i]), 1e-10) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, LinearTerm, testing::ValuesIn(Ids(true)), Name);

TEST(ThermalTerms, StepsOfASecondDo) {
  for (const TermInfo& info : Catalogue()) {
    if (!info.id.starts_with("thermal.")) continue;
    Model model;
    model.terms.emplace_back(info.id);
    double error_k = 0, matters_k = 0;
    HeatModel coarse(model), fine(model), base({});
    for (int t_s = 0; t_s < 600; ++t_s) {
      Inputs inputs;
      inputs.drive_pct = t_s < 150 ? 100 : (t_s < 300 ? -100 : 40);
      coarse.Advance(1, inputs);
      for (int k = 0; k < 50; ++k) fine.Advance(0.02, inputs);
      base.Advance(1, inputs);
      const Temperatures a = coarse.shown(), b = fine.shown(), c = base.shown();
      error_k = std::max(
          {error_k, std::fabs(a.die_degc - b.die_degc), std::fabs(a.plate_degc - b.plate_degc)});
      matters_k = std::max(
          {matters_k, std::fabs(c.die_degc - b.die_degc), std::fabs(c.plate_degc - b.plate_degc)});
    }
    EXPECT_GT(matters_k, 0.02) << info.id;
    EXPECT_LT(error_k / matters_k, 0.015) << info.id;
  }
}

TEST(ThermalTerms, TheBalanceOfPlateAndBoardHoldsWithAllOfThem) {
  Model model;
  for (const TermInfo& info : Catalogue()) {
    if (info.id.starts_with("thermal.")) model.terms.emplace_back(info.id);
  }
  ASSERT_GT(model.terms.size(), 10u);
  HeatModel heat(model);
  double flowed_j = 0;
  for (int i = 0; i < 60000; ++i) {  // midpoint rule, 10 ms
    Inputs inputs;
    inputs.drive_pct = i < 30000 ? 90 : -70;
    heat.Advance(0.005, inputs);
    flowed_j += 0.01 * heat.NetHeatFlow() / 2;
  }
  EXPECT_NEAR(heat.StoredHeat() / flowed_j, 1, 2e-3);
}

}  // namespace
}  // namespace zrobench::physics
