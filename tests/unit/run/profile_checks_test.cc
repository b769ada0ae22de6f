// The checks of the longer profiles on evidence made by hand: gaps, dates, directions, reach.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "rig/run/checks/checks.h"

namespace zrobench {
namespace {

using testing::HasSubstr;
using Arguments = std::vector<std::pair<std::string, Expectation::Value>>;

constexpr std::uint64_t kS = 1'000'000;

class ProfileChecks : public testing::Test {
 protected:
  CheckResult Run(const std::string& check, Arguments arguments = {}) {
    return RunCheck({check, std::move(arguments), 1}, {evidence_, station_, "nowhere.ulg"});
  }
  Verdict VerdictOf(const std::string& check, Arguments arguments = {}) {
    return Run(check, std::move(arguments)).verdict;
  }
  void Decide(double at_s, zro::Code code, double degc = 25) {
    evidence_.decisions.push_back(
        {static_cast<std::uint64_t>(at_s * 1e6), {.code = code, .temp_degc = degc}});
  }
  struct Pair {
    float degc;
    std::uint16_t date = 100;
    zro::Origin origin = zro::Origin::kLearned;
  };
  void HoldTable(const std::vector<Pair>& pairs, std::uint64_t at_us = 9 * kS,
                 std::uint8_t when = 3, std::uint32_t generation = 1) {
    zro::Table table;
    for (const Pair& p : pairs) {
      ASSERT_TRUE(table.Insert({p.degc, {0.5f, 0.5f, 0.5f}, 0.001f, p.date, 1, p.origin}));
    }
    TableItem item{at_us, when, 0, {}};
    item.image.resize(zro::Table::kMaxImageBytes);
    item.image.resize(table.ToImage(generation, item.image.data()));
    evidence_.tables.push_back(item);
  }
  void Second(double degc, double raw_dps, double rate_dps, bool quiet = true) {
    MeanItem mean{.at_us = (evidence_.seconds.size() + 1) * kS};
    mean.imu_degc = static_cast<float>(degc);
    mean.samples = 200;
    mean.raw_dps.fill(static_cast<float>(raw_dps));
    mean.rate_dps.fill(static_cast<float>(rate_dps));
    evidence_.seconds.push_back({mean, quiet});
  }
  Evidence evidence_;
  Station station_;
};

TEST_F(ProfileChecks, ARefusalWithoutAStimulusIsUnexpected) {
  const auto verdict = [&](double at_most) {
    return VerdictOf("no_unexpected_rejection", {{"at_most", at_most}});
  };
  evidence_.stimuli = {{10 * kS, 20 * kS, "tone"}};
  Decide(15, zro::Code::kGyroVariance);
  Decide(27, zro::Code::kDiffersFromEntry);  // the echo
  Decide(50, zro::Code::kRetry);             // no refusal
  EXPECT_EQ(verdict(0), Verdict::kPass);
  Decide(29, zro::Code::kDiffersFromEntry);
  EXPECT_EQ(verdict(0), Verdict::kFail);
  EXPECT_EQ(verdict(1), Verdict::kPass);
  evidence_.decisions_lost = 1;
  EXPECT_EQ(verdict(1), Verdict::kInconclusive);
  EXPECT_EQ(verdict(0), Verdict::kFail);  // one too many is one too many
}

TEST_F(ProfileChecks, DecisionsAreCounted) {
  const auto verdict = [&](double at_least, double at_most) {
    return VerdictOf(
        "decides",
        {{"codes", std::vector<double>{34, 37}}, {"at_least", at_least}, {"at_most", at_most}});
  };
  Decide(5, zro::Code::kOverwroteOld);
  Decide(6, zro::Code::kMerged);
  Decide(7, zro::Code::kShiftConfirmed);
  EXPECT_EQ(verdict(2, 2), Verdict::kPass);
  EXPECT_EQ(verdict(3, 9), Verdict::kFail);
  EXPECT_EQ(verdict(0, 1), Verdict::kFail);
  evidence_.decisions_lost = 1;
  EXPECT_EQ(verdict(0, 1), Verdict::kFail);
  EXPECT_EQ(verdict(3, 9), Verdict::kInconclusive);
  EXPECT_EQ(verdict(0, 2), Verdict::kInconclusive);
}

TEST_F(ProfileChecks, TheTableIsCompleteUntilTheBoardTakesItBack) {
  EXPECT_EQ(VerdictOf("table_complete"), Verdict::kFail);
  Decide(5, zro::Code::kTableComplete);
  EXPECT_EQ(VerdictOf("table_complete"), Verdict::kPass);
  Decide(9, zro::Code::kReArmed);
  EXPECT_EQ(VerdictOf("table_complete"), Verdict::kFail);
  evidence_.decisions_lost = 1;
  EXPECT_EQ(VerdictOf("table_complete"), Verdict::kInconclusive);
}

TEST_F(ProfileChecks, TheLargestGapBetweenLearnedEntriesCountsAndSoDoTheEnds) {
  const auto gap = [&](double from, double to) {
    const CheckResult result =
        Run("granularity", {{"from_degc", from}, {"to_degc", to}, {"within_degc", 3.0}});
    return result.measurements.empty() ? std::nan("") : result.measurements[0].value;
  };
  EXPECT_TRUE(std::isnan(gap(20, 28)));
  HoldTable({{20}, {23}, {24, 100, zro::Origin::kFactory}, {27}});
  EXPECT_NEAR(gap(20, 27), 4, 1e-6);  // the factory's entry fills nothing
  EXPECT_NEAR(gap(20, 23), 3, 1e-6);
  EXPECT_NEAR(gap(14, 23), 6, 1e-6);
  EXPECT_NEAR(gap(20, 35), 8, 1e-6);
  EXPECT_NEAR(gap(40, 50), 10, 1e-6);  // none there
}

TEST_F(ProfileChecks, EntriesAreDatedAndYoung) {
  const auto verdict = [&] { return VerdictOf("entry_age", {{"at_most_days", 2.0}}); };
  HoldTable({{20, 0, zro::Origin::kFactory}});
  evidence_.today_days = 102;
  EXPECT_EQ(verdict(), Verdict::kInconclusive);  // nothing was learned
  HoldTable({{20, 0, zro::Origin::kFactory}, {25, 100}, {28, 102}});
  EXPECT_EQ(verdict(), Verdict::kPass);
  evidence_.today_days = 103;
  EXPECT_EQ(verdict(), Verdict::kFail);
  evidence_.today_days = 101;  // 28 degC is dated tomorrow
  EXPECT_EQ(verdict(), Verdict::kFail);
  evidence_.today_days = 0;
  EXPECT_EQ(verdict(), Verdict::kInconclusive);
  evidence_.today_days = 102;
  HoldTable({{25, 0}});
  const CheckResult undated = Run("entry_age", {{"at_most_days", 2.0}});
  EXPECT_EQ(undated.verdict, Verdict::kFail);
  EXPECT_THAT(undated.reason, HasSubstr("undated"));
  HoldTable({{25, 0}, {40, 102}});
  EXPECT_EQ(VerdictOf("entry_age", {{"at_most_days", 2.0}, {"from_degc", 30.0}}), Verdict::kPass);
}

TEST_F(ProfileChecks, WarmingAndCoolingAreComparedAtEachLearnedTemperature) {
  const auto run = [&] { return Run("up_down", {{"within_mdps", 10.0}}); };
  const auto ramp = [&](double from, double to, double offset_dps) {
    for (double t = from; to > from ? t < to : t > to; t += to > from ? 0.1 : -0.1) {
      Second(t, 0.03 * t + offset_dps, 0);
    }
  };
  HoldTable({{25}});
  ramp(20, 30, 0);
  EXPECT_EQ(run().verdict, Verdict::kInconclusive);  // one way only
  ramp(30, 20, 0.004);
  EXPECT_EQ(run().verdict, Verdict::kPass);
  EXPECT_NEAR(run().measurements[0].value, -4, 0.1);
  evidence_.seconds.clear();
  ramp(20, 30, 0);
  ramp(30, 20, 0.05);
  EXPECT_EQ(run().verdict, Verdict::kFail);
}

TEST_F(ProfileChecks, TheCorrectionMustNotMoveFarOutsideTheTable) {
  const auto run = [&] {
    return Run("extrapolation_held", {{"beyond_degc", 10.0}, {"within_mdps", 5.0}});
  };
  EXPECT_EQ(run().verdict, Verdict::kInconclusive);
  HoldTable({{20}, {30}});
  for (int i = 0; i < 20; ++i) Second(15 + i, 0.5, 0.03 * i);  // it may follow here
  EXPECT_EQ(run().verdict, Verdict::kInconclusive);
  for (int i = 0; i < 20; ++i) Second(41 + 0.2 * i, 0.5 + 0.01 * i, 0.1 + 0.01 * i);
  EXPECT_EQ(run().verdict, Verdict::kPass);
  for (int i = 0; i < 20; ++i) Second(9 - 0.2 * i, 0.5, 0.001 * i, false);  // also while shaken
  EXPECT_EQ(run().verdict, Verdict::kFail);
}

TEST_F(ProfileChecks, ResidualRateLooksWhereItIsToldInPiecesAsLongAsItIsTold) {
  for (int i = 0; i < 30; ++i) Second(i < 15 ? 10 : 20, 0.5, i < 15 ? 0.2 : 0.01, i % 3 != 0);
  EXPECT_EQ(VerdictOf("residual_rate", {{"within_mdps", 50.0}}), Verdict::kInconclusive);
  EXPECT_EQ(VerdictOf("residual_rate", {{"within_mdps", 50.0}, {"piece_s", 2.0}}), Verdict::kFail);
  EXPECT_EQ(
      VerdictOf("residual_rate",
                {{"within_mdps", 50.0}, {"piece_s", 2.0}, {"from_degc", 15.0}, {"to_degc", 25.0}}),
      Verdict::kPass);
}

TEST_F(ProfileChecks, OnlyWhatWasWrittenInTheSecondBeforeTheCutMayBeGone) {
  HoldTable({{20}, {25}}, 10 * kS, 1);
  HoldTable({{20}}, 20 * kS, 2);
  evidence_.cuts = {{12 * kS, true}};
  EXPECT_EQ(VerdictOf("table_persists"), Verdict::kFail);
  Decide(11.4, zro::Code::kNew, 25);
  EXPECT_EQ(VerdictOf("table_persists"), Verdict::kPass);
  evidence_.decisions.clear();
  Decide(10.4, zro::Code::kNew, 25);  // it had time to be stored
  EXPECT_EQ(VerdictOf("table_persists"), Verdict::kFail);
  evidence_.decisions.clear();
  Decide(11.4, zro::Code::kNew, 20);  // another one
  EXPECT_EQ(VerdictOf("table_persists"), Verdict::kFail);
}

TEST_F(ProfileChecks, WhatWasStoredAfterTheFirstLookMayBeMore) {
  HoldTable({{20}}, 10 * kS, 1, 7);
  HoldTable({{20}, {25}}, 20 * kS, 2, 8);
  evidence_.cuts = {{12 * kS, true}};
  EXPECT_EQ(VerdictOf("table_persists"), Verdict::kPass);
  evidence_.tables.clear();
  HoldTable({{20}}, 10 * kS, 1, 7);
  HoldTable({{20}}, 20 * kS, 2, 6);  // an older table than the stored one
  EXPECT_EQ(VerdictOf("table_persists"), Verdict::kFail);
}

}  // namespace
}  // namespace zrobench
