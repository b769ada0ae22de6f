// Figure 5, block by block, on the pure decision. docs/patent-map.md lists these names.
#include <gtest/gtest.h>

#include "corrector/sanity.h"
#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

constexpr std::uint16_t kToday = 15000;

float Curve(float temp_degc) { return 0.8f + 0.03f * (temp_degc - 25.0f); }

Entry At(float temp_degc, Origin origin, std::uint16_t date, float error_dps = 0.0f) {
  const float zro = Curve(temp_degc) + error_dps;
  return {temp_degc, {zro, -zro, 0.1f}, 0.002f, date, 3, origin};
}
Summary ReadAt(float temp_degc, float error_dps = 0.0f) {
  Summary s{};
  s.temp_degc = temp_degc;
  s.zro_dps[0] = Curve(temp_degc) + error_dps;
  s.zro_dps[1] = -Curve(temp_degc);
  s.zro_dps[2] = 0.1f;
  s.sigma_dps = 0.0025f;
  s.samples = 1000;
  return s;
}
Table Factory() {
  Table table;
  for (const float t : {10.0f, 25.0f, 40.0f}) table.Insert(At(t, Origin::kFactory, 0));
  return table;
}
Decision Check(const Table& table, const Summary& reading, std::uint16_t today = kToday,
               bool may_merge = true) {
  static const Config config;
  return CheckSanity(table, reading, Age(today, config), config.limits, may_merge);
}

TEST(Patent, Fig5Block56_ComparesWithTheEstimateWhereNoEntryIsClose) {
  const Decision d = Check(Factory(), ReadAt(17.5f, 0.04f));
  EXPECT_EQ(d.finding.code, Code::kNew);
  EXPECT_NEAR(d.finding.value, 0.04f, 1e-3f);  // from the estimate
  EXPECT_NEAR(d.expected_dps[0], Curve(17.5f), 1e-3f);
}

TEST(Patent, Fig5Block56_ExtrapolatesOutsideTheTable) {
  EXPECT_EQ(Check(Factory(), ReadAt(47.0f)).finding.code, Code::kNew);
  EXPECT_EQ(Check(Factory(), ReadAt(47.0f, 0.2f)).finding.code, Code::kDiffersFromEstimate);
}

TEST(Patent, Fig5Block58_DiscardsWhatTheEstimateContradicts) {
  for (const float shift : {0.2f, -0.2f, 0.5f, 5.0f}) {
    const Decision d = Check(Factory(), ReadAt(17.5f, shift));
    EXPECT_EQ(d.finding.code, Code::kDiffersFromEstimate) << shift;
    EXPECT_EQ(d.finding.axis, 0);
    EXPECT_GT(d.finding.value, d.finding.limit);
  }
}

TEST(Patent, Fig5Block58_DiscardsWhatCloseEntryAndEstimateContradict) {
  Table table = Factory();
  for (const float t : {18.0f, 20.5f, 23.0f}) table.Insert(At(t, Origin::kLearned, kToday));
  EXPECT_EQ(Check(table, ReadAt(20.6f, 0.2f)).finding.code, Code::kDiffersFromEntry);
}

TEST(Patent, Fig5Block59_OverridesABadEntryWhenTheOthersAgreeWithTheReading) {
  Table table = Factory();
  table.Insert(At(18.0f, Origin::kLearned, kToday));
  table.Insert(At(20.5f, Origin::kLearned, kToday, 0.3f));  // the bad one
  table.Insert(At(23.0f, Origin::kLearned, kToday));
  const Decision d = Check(table, ReadAt(20.5f));
  EXPECT_EQ(d.finding.code, Code::kOverwroteOld);
  EXPECT_FLOAT_EQ(table[d.entry].temp_degc, 20.5f);
}

TEST(Patent, Fig5Block59_DoesNotOverrideOnARemoteWitness) {
  Table table;
  table.Insert(At(5.0f, Origin::kFactory, 0));
  table.Insert(At(20.5f, Origin::kLearned, kToday, 0.3f));
  table.Insert(At(45.0f, Origin::kFactory, 0));
  EXPECT_EQ(Check(table, ReadAt(20.5f)).finding.code, Code::kDiffersFromEntry);
}

TEST(Patent, Fig5Block54_OldEntryIsOverwritten) {
  Table table = Factory();
  table.Insert(At(20.5f, Origin::kLearned, kToday - 31));
  const Decision d = Check(table, ReadAt(20.6f, 0.03f));
  EXPECT_EQ(d.finding.code, Code::kOverwroteOld);
  EXPECT_FLOAT_EQ(table[d.entry].temp_degc, 20.5f);
}

TEST(Patent, Fig5Block57_RecentEntryThatAgreesLeavesNothingToDo) {
  Table table = Factory();
  table.Insert(At(20.5f, Origin::kLearned, kToday));
  EXPECT_EQ(Check(table, ReadAt(20.6f)).finding.code, Code::kRecentNothingToDo);
  // A close one that says a little more is merged, where that is allowed; never overwritten.
  EXPECT_EQ(Check(table, ReadAt(20.6f, 0.03f)).finding.code, Code::kMerged);
  // More of the same still makes a coarse entry finer, a fine one needs no more of it.
  EXPECT_EQ(Check(table, ReadAt(20.6f), kToday, false).finding.code, Code::kMerged);
  Entry fine = At(20.5f, Origin::kLearned, kToday);
  fine.sigma_dps = 0.001f;
  table.Insert(fine);
  EXPECT_EQ(Check(table, ReadAt(20.6f, 0.03f), kToday, false).finding.code,
            Code::kRecentNothingToDo);
}

TEST(Fig5, EntryNeitherOldNorRecentIsMergedAndSoRefreshed) {
  Table table = Factory();
  table.Insert(At(20.5f, Origin::kLearned, kToday - 10));
  EXPECT_EQ(Check(table, ReadAt(20.6f)).finding.code, Code::kMerged);
}

TEST(Fig5, EmptyTableCanOnlyCheckTheBiasLimit) {
  const Decision d = Check(Table(), ReadAt(20.0f));
  EXPECT_EQ(d.finding.code, Code::kNew);
  EXPECT_FLOAT_EQ(d.finding.limit, Limits{}.max_bias_dps);
}

TEST(Fig5, ReadingNearAFactoryEntryBecomesNewBesideIt) {
  const Decision d = Check(Factory(), ReadAt(25.1f, 0.03f));
  EXPECT_EQ(d.finding.code, Code::kNew);
  EXPECT_EQ(d.entry, -1);
}

TEST(Fig5, ToleranceGrowsWithAgeAndDistanceWithinItsBound) {
  const auto limit = [](std::uint16_t date, float temp) {
    Table table;
    table.Insert(At(20.0f, Origin::kLearned, date));
    table.Insert(At(30.0f, Origin::kLearned, date));
    return Check(table, ReadAt(temp)).finding.limit;
  };
  EXPECT_LT(limit(kToday, 20.0f), limit(kToday - 20, 20.0f));
  EXPECT_LT(limit(kToday, 20.0f), limit(kToday, 33.0f));
  EXPECT_LE(limit(1, 39.0f), 3.0f * Limits{}.max_step_dps + 1e-6f);
}

TEST(Fig5, WithoutADateNothingIsOldAndADateMakesUndatedEntriesOld) {
  Table table = Factory();
  table.Insert(At(20.5f, Origin::kLearned, 0));
  EXPECT_EQ(Check(table, ReadAt(20.6f), 0).finding.code, Code::kRecentNothingToDo);
  EXPECT_EQ(Check(table, ReadAt(20.6f), kToday).finding.code, Code::kOverwroteOld);
}

TEST(Fig5, DateGoneBackByADayIsHarmlessByMoreTheEntryIsRedated) {
  Table table = Factory();
  table.Insert(At(20.5f, Origin::kLearned, kToday + 1));
  EXPECT_EQ(Check(table, ReadAt(20.6f)).finding.code, Code::kRecentNothingToDo);
  EXPECT_EQ(Check(table, ReadAt(20.6f), kToday - 100).finding.code, Code::kOverwroteOld);
}

TEST(Fig5, MergeWeighsByVarianceAndKeepsListening) {
  static const Config config;
  const Age age(kToday, config);
  Entry sure = At(20.5f, Origin::kLearned, kToday);
  sure.sigma_dps = 0.0001f;
  const Entry merged = Merge(sure, ReadAt(20.5f, 0.04f), age, true);
  EXPECT_NEAR(merged.zro_dps[0], Curve(20.5f) + 0.005f, 1e-4f);  // an eighth at least
  Entry vague = At(20.5f, Origin::kLearned, kToday);
  vague.sigma_dps = 0.1f;
  EXPECT_NEAR(Merge(vague, ReadAt(20.5f, 0.04f), age, true).zro_dps[0], Curve(20.5f) + 0.04f,
              1e-3f);
  EXPECT_EQ(merged.weight, 4);
  EXPECT_EQ(Merge(sure, ReadAt(20.5f), age, false).weight, 3);  // one still is one witness
}

}  // namespace
}  // namespace zro
