// The claims of US 8,577,633 B2 as behaviour. docs/patent-map.md lists these names.
#include <gtest/gtest.h>

#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using test::Bench;
using test::Scene;
using test::TrueOffset;
using test::Vector;

constexpr std::uint16_t kToday = 15000;

double WorstCorrected(Bench& bench, double temp_degc) {
  double sum[3] = {};
  int n = 0;
  bench.Run(
      5.0,
      [&](double) {
        return Scene{temp_degc, {0, 0, 0}, 1.0, false};
      },
      [&](const Scene&, const Output& out) {
        for (int i = 0; i < 3; ++i) sum[i] += static_cast<double>(out.rate_dps[i]);
        ++n;
      });
  double worst = 0.0;
  for (const double s : sum) worst = std::max(worst, std::abs(s / n));
  return worst;
}

TEST(Patent, Claim1_LearnsAPairWhileMotionlessAndCorrectsWithIt) {
  Bench bench;
  EXPECT_GT(WorstCorrected(bench, 25.0), 0.5);  // nothing known yet
  bench.Rest(7.0, 25.0);
  bench.Shake(1.0);
  bench.Rest(7.0, 28.0);
  EXPECT_EQ(bench.table().size(), 2);
  EXPECT_LT(WorstCorrected(bench, 28.0), 0.01);
  EXPECT_LT(WorstCorrected(bench, 25.0), 0.01);
}

TEST(Patent, Claim2_MotionlessMeansWithinAThresholdForSeveralSeconds) {
  Bench bench;
  bench.noise.accel_g = 0.06;  // four times the threshold, nothing else wrong
  bench.Rest(30.0);
  EXPECT_EQ(bench.table().size(), 0);
  bench.noise.accel_g = 0.002;
  bench.Rest(7.0);
  EXPECT_EQ(bench.table().size(), 1);
}

TEST(Patent, Claim3_TemperatureIsTheGyroPackagesOwnReadAtTheSameTime) {
  Bench bench;
  bench.Run(30.0, [](double t) { return Scene{20.0 + 4.0 / 60.0 * t}; });
  ASSERT_GE(bench.table().size(), 1);
  for (int i = 0; i < bench.table().size(); ++i) {
    const Entry& e = bench.table()[i];
    EXPECT_NEAR(e.zro_dps[0], TrueOffset(static_cast<double>(e.temp_degc))[0], 0.01);
  }
}

TEST(Patent, Claim4_TheMotionSensorIsAnAccelerometer) {
  Bench bench;
  for (int i = 0; i < 4000; ++i) {  // linear motion only: the gyro sees none of it
    Sample s = bench.Make(Scene{});
    s.accel_g[0] += 0.05f * static_cast<float>(std::sin(0.06 * i));
    bench.Step(s);
  }
  EXPECT_EQ(bench.table().size(), 0);
}

TEST(Patent, Claim5_SanityCheckRefusesWhatIsOutsideTheExpectedRange) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  bench.Rest(40.0, 22.0, {0.0, 0.3, 0.0});
  EXPECT_EQ(bench.Writes(), 0);
  EXPECT_GE(bench.Count(Code::kDiffersFromEntry) + bench.Count(Code::kDiffersFromEstimate), 1);
}

TEST(Patent, Claim6_ExpectedRangeComesFromStoredPairs) {
  Bench bench;
  bench.corrector().SetDate(kToday);
  for (const double t : {20.0, 23.0, 26.0, 29.0}) {
    bench.Rest(7.0, t);
    bench.Shake(1.0, t);
  }
  bench.events.clear();
  bench.Rest(40.0, 24.5, {0.2, 0.0, 0.0});  // refused by what was learned alone
  EXPECT_EQ(bench.Writes(), 0);
  EXPECT_GE(bench.Count(Code::kDiffersFromEntry), 1);
}

TEST(Patent, Claim7_ShipsWithFactoryEntries) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  EXPECT_EQ(bench.table().size(), 3);
  EXPECT_LT(WorstCorrected(bench, 25.0), 0.02);  // before anything was learned
  EXPECT_EQ(bench.Writes(), 0);
}

TEST(Patent, Claim8_EstimateInterpolatesBetweenStoredPairs) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  EXPECT_LT(bench.ErrorAt(17.5), 0.03);
  bench.Rest(7.0, 17.5);
  EXPECT_EQ(bench.Count(Code::kNew), 1);
}

TEST(Patent, Claim9_EstimateExtrapolatesBeyondStoredPairs) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  bench.Rest(7.0, 45.0);
  EXPECT_EQ(bench.Count(Code::kNew), 1);
  Bench tone;
  tone.AddFactory({10, 25, 40});
  tone.Rest(40.0, 45.0, {0.25, 0.25, 0.25});
  EXPECT_EQ(tone.Writes(), 0);
}

TEST(Patent, Claim10_CorrectionInterpolatesAtThePresentTemperature) {
  Bench bench;
  bench.corrector().SetDate(kToday);
  for (const double t : {21.0, 24.0}) {
    bench.Rest(7.0, t);
    bench.Shake(1.0, t);
  }
  EXPECT_LT(WorstCorrected(bench, 22.5), 0.012);
}

TEST(Patent, Claim11_FactoryPairsStayTheReferenceBeneathLearnedOnes) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  bench.Rest(7.0, 25.0);
  ASSERT_EQ(bench.Count(Code::kNew), 1);
  EXPECT_EQ(bench.table().size(), 4);
  EXPECT_LT(bench.ErrorAt(39.0), 0.02);  // the learned pair alone would be 0.4 dps off
  bench.Shake(1.0, 39.0);
  bench.Rest(40.0, 39.0, {0.3, 0.0, 0.0});  // refused by the factory's pair
  EXPECT_EQ(bench.Writes(), 1);
  bench.corrector().RestoreFactory();
  EXPECT_EQ(bench.table().size(), 3);
  EXPECT_EQ(bench.table()[1].origin, Origin::kFactory);
}

TEST(Patent, Claim12_ReadingCloseToTheEstimateIsWritten) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  bench.Rest(7.0, 32.0, {0.03, -0.03, 0.0});
  EXPECT_EQ(bench.Count(Code::kNew), 1);
}

TEST(Patent, Claim13_ReadingNotCloseToTheEstimateIsDiscarded) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  const Estimate before = bench.table().At(32.0f);
  bench.Rest(60.0, 32.0, {0.2, 0.0, 0.0});
  EXPECT_EQ(bench.Writes(), 0);
  EXPECT_FLOAT_EQ(bench.table().At(32.0f).zro_dps[0], before.zro_dps[0]);
}

}  // namespace
}  // namespace zro
