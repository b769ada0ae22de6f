// Figure 4, block by block, through the corrector's face. docs/patent-map.md lists these names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using test::Bench;
using test::Scene;
using testing::ElementsAre;

constexpr std::uint16_t kToday = 15000;

TEST(Patent, Fig4Block34_WatchesTheMotionSensorOverSeveralSeconds) {
  Bench bench;
  bool still = false;
  bench.Run(
      1.9, [](double) { return Scene{}; },
      [&](const Scene&, const Output& out) { still = still || out.still; });
  EXPECT_FALSE(still);
  bench.Run(
      0.2, [](double) { return Scene{}; },
      [&](const Scene&, const Output& out) { still = out.still; });
  EXPECT_TRUE(still);
}

TEST(Patent, Fig4Block36_MotionPreventsLearningAndIsReportedOnce) {
  Bench bench;
  bench.Shake(60.0);
  EXPECT_EQ(bench.events.size(), 0u);  // nothing was interrupted
  EXPECT_EQ(bench.table().size(), 0);
  bench.Rest(10.0);
  bench.Shake(20.0);
  EXPECT_THAT(bench.Codes(), ElementsAre(Code::kNew, Code::kMotion));
  EXPECT_GT(bench.events[1].value, bench.events[1].limit);
}

TEST(Fig4, StillThatEndsBeforeItsFirstReadingIsTooShort) {
  Bench bench;
  bench.Rest(4.0);
  bench.Shake(2.0);
  ASSERT_THAT(bench.Codes(), ElementsAre(Code::kTooShort));
  EXPECT_NEAR(bench.events[0].value, 3.5f, 0.1f);  // seconds gathered ...
  EXPECT_FLOAT_EQ(bench.events[0].limit, 5.0f);    // ... of
}

TEST(Fig4, StillShorterThanStillnessItselfSaysNothing) {
  Bench bench;
  for (int i = 0; i < 10; ++i) {
    bench.Rest(1.5);
    bench.Shake(2.0);
  }
  EXPECT_TRUE(bench.events.empty());
}

TEST(Fig4, StillsOfSixAndAHalfSecondsAllTeach) {
  Bench bench;
  for (int i = 0; i < 40; ++i) {
    bench.Rest(6.5, 20.0 + 0.4 * i);
    bench.Shake(10.0, 20.0 + 0.4 * i);
  }
  EXPECT_EQ(bench.Writes() + bench.Count(Code::kRecentNothingToDo), 40);
}

TEST(Patent, Fig4Block38And40_AveragesTemperatureAndGyroOverTheSameWindow) {
  Bench bench;
  const double rate = 3.0 / 60.0;
  bench.Run(6.0, [&](double t) { return Scene{25.0 + rate * t}; });
  ASSERT_EQ(bench.Count(Code::kNew), 1);
  const Entry entry = bench.table()[0];
  EXPECT_NEAR(entry.temp_degc, 25.0 + rate * 3.0, 0.02);  // the window is 0.5 to 5.5 s
  EXPECT_NEAR(entry.zro_dps[0], test::TrueOffset(entry.temp_degc)[0], 0.008);
}

TEST(Patent, Fig4Block42_ReReadsWithinTheStillBeforeItDiscards) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  bench.Rest(24.0, 25.0, {0.0, 0.0, 0.5});
  EXPECT_THAT(bench.Codes(), ElementsAre(Code::kRetry, Code::kRetry, Code::kRetry,
                                         Code::kDiffersFromEntry, Code::kQuarantined));
  EXPECT_EQ(bench.Writes(), 0);
}

TEST(Fig4, StillThatEndsDuringReReadsGivesTheMismatchAsItsReason) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  bench.Rest(8.0, 17.0, {0.5, 0.0, 0.0});
  bench.Shake(2.0, 17.0);
  EXPECT_THAT(bench.Codes(),
              ElementsAre(Code::kRetry, Code::kDiffersFromEstimate, Code::kQuarantined));
}

TEST(Patent, Fig4Block44_WritesThePairWithDateAndUncertainty) {
  Bench bench;
  bench.corrector().SetDate(kToday);
  int updates = 0;
  bench.Run(
      6.0, [](double) { return Scene{31.0}; },
      [&](const Scene&, const Output& out) { updates += out.updated ? 1 : 0; });
  ASSERT_EQ(bench.table().size(), 1);
  const Entry& entry = bench.table()[0];
  EXPECT_EQ(entry.date, kToday);
  EXPECT_EQ(entry.origin, Origin::kLearned);
  EXPECT_NEAR(entry.temp_degc, 31.0, 0.01);
  EXPECT_GT(entry.sigma_dps, 0.001f);
  EXPECT_LT(entry.sigma_dps, 0.004f);
  EXPECT_EQ(updates, 1);
}

TEST(Patent, Fig4Block44_UpdatesTheEntryAtThatTemperature) {
  Bench bench;
  bench.corrector().SetDate(kToday);
  bench.Rest(7.0, 31.0);
  bench.Shake(1.0, 31.0);
  bench.corrector().SetDate(kToday + 40);
  bench.Rest(7.0, 31.0);
  EXPECT_EQ(bench.Count(Code::kOverwroteOld), 1);
  ASSERT_EQ(bench.table().size(), 1);
  EXPECT_EQ(bench.table()[0].date, kToday + 40);
}

TEST(Fig4, MergedEntryCarriesTheDayOfTheMerge) {
  Bench bench;
  bench.corrector().SetDate(kToday);
  bench.Rest(7.0, 31.0);
  bench.Shake(1.0, 31.0);
  bench.corrector().SetDate(kToday + 10);  // neither recent nor old
  bench.Rest(7.0, 31.0);
  ASSERT_EQ(bench.Count(Code::kMerged), 1);
  EXPECT_EQ(bench.table()[0].date, kToday + 10);
}

Config Covering(float from_degc, float to_degc) {
  Config config;
  config.coverage_min_degc = from_degc;
  config.coverage_max_degc = to_degc;
  return config;
}

void Learn(Bench& bench, std::initializer_list<double> temps_degc) {
  for (const double t : temps_degc) {
    bench.Rest(7.0, t);
    bench.Shake(1.0, t);
  }
}

TEST(Patent, Fig4Block46_StopsWhenTheTableIsCompleteAndFresh) {
  Bench bench(Covering(20.0f, 27.5f));
  bench.corrector().SetDate(kToday);
  Learn(bench, {21.0, 23.5});
  EXPECT_FALSE(bench.corrector().complete());
  Learn(bench, {26.0});
  EXPECT_TRUE(bench.corrector().complete());
  EXPECT_EQ(bench.Count(Code::kTableComplete), 1);
  bench.Shake(1.0);
  bench.events.clear();
  Learn(bench, {21.5, 24.0});
  bench.Rest(600.0, 24.0);
  EXPECT_TRUE(bench.events.empty());  // nothing written, nothing refused, nothing to say
  EXPECT_EQ(bench.table().size(), 3);
}

TEST(Fig4, CompleteTableStillTakesInATemperatureBeyondItsCoverage) {
  Bench bench(Covering(20.0f, 25.0f));
  bench.corrector().SetDate(kToday);
  Learn(bench, {21.0, 23.5});
  ASSERT_TRUE(bench.corrector().complete());
  bench.events.clear();
  Learn(bench, {26.0, 21.0, 26.0});
  EXPECT_EQ(bench.Count(Code::kNew), 1);
  EXPECT_EQ(bench.Count(Code::kReArmed), 0);
  EXPECT_EQ(bench.table().size(), 3);
  EXPECT_TRUE(bench.corrector().complete());
}

TEST(Fig4, CompleteTableStillNoticesAShift) {
  Bench bench(Covering(20.0f, 25.0f));
  bench.corrector().SetDate(kToday);
  Learn(bench, {21.0, 23.5});
  bench.events.clear();
  bench.Rest(8.0, 22.0, {0.5, 0.0, 0.0});
  bench.Shake(1.0, 22.0);
  EXPECT_THAT(bench.Codes(),
              ElementsAre(Code::kRetry, Code::kDiffersFromEntry, Code::kQuarantined));
}

TEST(Patent, Fig4Block46_ReArmsByAgeAndByGap) {
  Bench bench(Covering(20.0f, 25.0f));
  bench.corrector().SetDate(kToday);
  Learn(bench, {21.0, 23.5});
  ASSERT_TRUE(bench.corrector().complete());
  bench.corrector().SetDate(kToday + 31);
  EXPECT_FALSE(bench.corrector().complete());
  Learn(bench, {21.0, 23.5});
  EXPECT_EQ(bench.Count(Code::kOverwroteOld), 2);
  EXPECT_TRUE(bench.corrector().complete());
  bench.corrector().RestoreFactory();
  EXPECT_FALSE(bench.corrector().complete());
  bench.Rest(1.0);
  EXPECT_EQ(bench.Count(Code::kReArmed), 2);
}

TEST(Fig4, FactoryEntryThatCostsAFullTableALearnedOneReArms) {
  Bench bench(Covering(-40.0f, -35.0f));
  bench.corrector().SetDate(kToday);
  Table full;
  for (int bin = 0; bin < Table::kCapacity; ++bin) {  // the oldest entry is in the coverage
    const float temp = -39.0f + 2.5f * static_cast<float>(bin);
    const auto date = static_cast<std::uint16_t>(kToday - (bin == 0 ? 20 : 1));
    full.Insert({temp, {0.0f, 0.0f, 0.0f}, 0.002f, date, 1, Origin::kLearned});
  }
  Store::Seal(full, 1, 1, bench.storage.slots[0].data());
  bench.corrector().Boot();
  ASSERT_TRUE(bench.corrector().complete());
  const float zro[3] = {};
  ASSERT_TRUE(bench.corrector().AddFactoryEntry(25.0f, zro, 0.005f));
  EXPECT_FALSE(bench.corrector().complete());
}

TEST(Fig4, HoursOfStillnessNeitherSpamNorPileUp) {
  Config config;
  config.sample_hz = 50.0f;
  config.limits.min_samples = 250;
  Bench bench(config);
  bench.corrector().SetDate(kToday);
  bench.AddFactory({10, 25, 40});
  bench.Rest(3 * 3600.0, 23.0);
  EXPECT_EQ(bench.Count(Code::kNew), 1);
  EXPECT_LE(bench.Count(Code::kRecentNothingToDo), 181);
  EXPECT_GE(bench.Count(Code::kRecentNothingToDo), 100);
  EXPECT_GE(bench.Count(Code::kMerged), 2);
  EXPECT_LE(bench.Count(Code::kMerged), 18);
  EXPECT_LT(bench.ErrorAt(23.0), 0.005);
}

}  // namespace
}  // namespace zro
