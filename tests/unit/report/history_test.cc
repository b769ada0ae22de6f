// What a report knows of a run, from a record whose every figure is foretold.
#include "rig/report/history.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "rig/report/coverage.h"
#include "rig/report/thin.h"
#include "tests/unit/report/small_record.h"

namespace zrobench {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::SizeIs;

History Small() {
  const SmallRecord record;
  auto history = ReadHistory(record.path());
  if (!history) throw std::runtime_error(history.error().message);
  return std::move(*history);
}

TEST(History, TimesCountFromTheRecordsStart) {
  const History h = Small();
  EXPECT_DOUBLE_EQ(h.duration_s, 60);
  EXPECT_EQ(h.start_us, SmallRecord::kStart_us);
  ASSERT_THAT(h.seconds, SizeIs(57));  // 60 less the three without supply
  EXPECT_DOUBLE_EQ(h.seconds.front().t_s, 1);
  EXPECT_EQ(h.damage, "");
}

TEST(History, DecisionsStandAtTheTimeTheyWereTaken) {
  const History h = Small();
  ASSERT_THAT(h.readings, SizeIs(4)) << "the damaged log record is left out";
  EXPECT_NEAR(h.readings[0].t_s, 15, 1e-6) << "across the wrap of the board's clock";
  EXPECT_NEAR(h.readings[1].t_s, 24.5, 1e-6);
  EXPECT_NEAR(h.readings[2].t_s, 43, 1e-6) << "its clock is not known yet: the time of reading";
  EXPECT_NEAR(h.readings[3].t_s, 55, 1e-6) << "the clock starts anew at a boot";
}

TEST(History, ARefusalIsExpectedWhileAStimulusActs) {
  const History h = Small();
  EXPECT_FALSE(h.readings[0].expected());
  EXPECT_EQ(h.readings[1].stimulus, 0);
  EXPECT_FALSE(h.readings[3].expected()) << "a power cut provokes nothing";
}

TEST(History, QuietIsNeitherInNorJustAfterAStimulus) {
  const History h = Small();
  std::vector<double> loud;
  for (const auto& second : h.seconds) {
    if (!second.quiet) loud.push_back(second.t_s);
  }
  EXPECT_THAT(loud, ElementsAre(21, 22, 23, 24, 25, 26, 27, 43, 44));
}

TEST(History, AToneIsMeasuredAgainstTheQuietBeforeIt) {
  const History h = Small();
  ASSERT_THAT(h.tones, SizeIs(1));
  EXPECT_DOUBLE_EQ(h.tones[0].from_s, 20);
  EXPECT_DOUBLE_EQ(h.tones[0].to_s, 25);
  EXPECT_DOUBLE_EQ(h.tones[0].hz, 27000);
  EXPECT_THAT(h.tones[0].shift_dps,
              ElementsAre(DoubleNear(0, 1e-6), DoubleNear(0, 1e-6), DoubleNear(0.3, 1e-6)));
}

TEST(History, TableAlarmsAndSupplyAreKept) {
  const History h = Small();
  EXPECT_EQ(h.table.size(), 2);
  ASSERT_THAT(h.alarms, SizeIs(1));
  EXPECT_DOUBLE_EQ(h.alarms[0].t_s, 50);
  ASSERT_THAT(h.stimuli, SizeIs(2));
  EXPECT_EQ(h.stimuli[1].kind, "off");
  EXPECT_DOUBLE_EQ(h.stimuli[1].to_s - h.stimuli[1].from_s, 2);
}

TEST(History, ACutRecordIsToldAsFarAsItGoes) {
  const SmallRecord record;
  const auto size = std::filesystem::file_size(record.path());
  std::filesystem::resize_file(record.path(), size - 100);
  const auto h = ReadHistory(record.path());
  ASSERT_TRUE(h);
  EXPECT_NE(h->damage, "");
  EXPECT_EQ(h->table.size(), 0) << "the table was the last message";
  EXPECT_THAT(h->readings, SizeIs(4));
}

TEST(History, NoRecordIsAnError) { EXPECT_FALSE(ReadHistory("/nowhere/record.ulg")); }

TEST(Coverage, SpansTheCommandedTemperaturesOnly) {
  const Coverage c = CoverageOf(Small());
  ASSERT_THAT(c.bins, SizeIs(5)) << "20 to 31 degC; not the 99 left there before";
  EXPECT_DOUBLE_EQ(c.bins.front().from_degc, 20);
  EXPECT_DOUBLE_EQ(c.bins.back().to_degc, 32.5);
}

TEST(Coverage, CountsBinsAxesAndCodes) {
  const Coverage c = CoverageOf(Small());
  EXPECT_TRUE(c.bins[0].factory);
  EXPECT_FALSE(c.bins[0].learned);
  EXPECT_FALSE(c.bins[0].any_reading());
  EXPECT_TRUE(c.bins[1].learned);
  EXPECT_EQ(c.bins[1].accepted, 1);
  EXPECT_THAT(c.bins[1].refused, ElementsAre(0, 0, 1, 0)) << "worst axis z";
  EXPECT_EQ(c.bins[1].codes[1], 1) << "code 2";
  EXPECT_EQ(c.bins[0].quiet_s, 12) << "20.2 to 22.4 degC at 0.2 degC/s";
  EXPECT_EQ(c.codes[1].expected, 1);
  EXPECT_EQ(c.codes[0].unexpected, 1);
  EXPECT_EQ(c.codes[2].expected + c.codes[2].unexpected, 0);
  EXPECT_THAT(c.blamed, ElementsAre(0, 1, 1));
}

TEST(Thinned, KeepsExtremesGapsAndOrder) {
  std::vector<std::array<double, 3>> rows;
  for (int i = 0; i < 100'000; ++i) rows.push_back({1.0 * i, std::sin(i * 0.01), 5});
  rows[31'234][1] = 40;
  rows[31'235][1] = -40;
  rows[77'777][2] = NAN;
  const auto thin = Thinned(rows, 3000);
  EXPECT_LE(thin.size(), 3500u);
  EXPECT_GE(thin.size(), 1000u);
  const auto has = [&](std::size_t row) {
    return std::any_of(thin.begin(), thin.end(),
                       [&](const auto& r) { return r[0] == rows[row][0]; });
  };
  EXPECT_TRUE(has(31'234) && has(31'235) && has(77'777));
  EXPECT_TRUE(std::is_sorted(thin.begin(), thin.end(),
                             [](const auto& a, const auto& b) { return a[0] < b[0]; }));
  EXPECT_EQ(Thinned(rows, rows.size()).size(), rows.size());
}

}  // namespace
}  // namespace zrobench
