// What the field does to a corrector: none of it may enter the table or stop the learning after.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using test::Bench;
using test::Scene;

class Abuse : public testing::Test {
 protected:
  Abuse() {
    bench_.corrector().SetDate(15000);
    bench_.AddFactory({10, 25, 40});
    bench_.Rest(7.0);
    bench_.Shake(1.0);
    bench_.events.clear();
  }
  /// Still samples for `for_s`, each spoilt by `touch`.
  template <typename Touch>
  void Spoil(double for_s, Touch touch) {
    for (int i = 0; i < static_cast<int>(for_s * 200); ++i) {
      Sample s = bench_.Make(Scene{});
      touch(i, &s);
      last_ = bench_.Step(s);
    }
  }
  void ExpectRecovery() {
    bench_.events.clear();
    bench_.Shake(1.0);
    bench_.Rest(7.0, 28.0);
    EXPECT_EQ(bench_.Count(Code::kNew), 1);
    EXPECT_LT(bench_.ErrorAt(28.0), 0.01);
    EXPECT_LT(bench_.ErrorAt(25.0), 0.01);
  }

  Bench bench_;
  Output last_{};
};

TEST_F(Abuse, RectifiedToneIsRefusedByItsNoise) {
  bench_.Run(
      60.0,
      [](double) {
        return Scene{25.0, {0.3, -0.2, 0.0}, 1.6};
      },
      [&](const Scene&, const Output& out) { last_ = out; });
  EXPECT_GE(bench_.Count(Code::kAcousticOrVibration), 3);
  EXPECT_EQ(bench_.Writes(), 0);
  EXPECT_TRUE(last_.vibration);
  ExpectRecovery();
}

TEST_F(Abuse, ToneWithoutNoiseIsRefusedByTheTable) {
  bench_.Rest(60.0, 32.0, {0.2, 0.0, 0.0});
  EXPECT_EQ(bench_.Writes(), 0);
  EXPECT_GE(bench_.Count(Code::kDiffersFromEstimate), 1);
  ExpectRecovery();
}

TEST_F(Abuse, SlowRotationAboutGravityIsRefusedByTheTable) {
  bench_.Rest(60.0, 25.0, {0.0, 0.0, 0.5});
  EXPECT_EQ(bench_.Writes(), 0);
  ExpectRecovery();
}

TEST_F(Abuse, NanNeverPoisonsAnything) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Spoil(20.0, [&](int i, Sample* s) {
    if (i % 300 == 0) s->rate_dps[i % 3] = nan;
    if (i % 500 == 0) s->accel_g[i % 3] = nan;
    if (i % 700 == 0) s->temp_degc = nan;
  });
  EXPECT_EQ(bench_.Writes(), 0);
  EXPECT_GE(bench_.Count(Code::kSampleGap), 1);
  Spoil(1.0, [&](int, Sample* s) {
    for (int i = 0; i < 3; ++i) s->rate_dps[i] = s->accel_g[i] = nan;
    s->temp_degc = nan;
  });
  for (const float zro : last_.zro_dps) EXPECT_TRUE(std::isfinite(zro));
  ExpectRecovery();
}

TEST_F(Abuse, GapsAndOverrunsRefuseTheReading) {
  Spoil(20.0, [](int i, Sample* s) { s->elapsed = i % 400 == 0 ? 3 : 1; });
  EXPECT_GE(bench_.Count(Code::kSampleGap), 2);
  EXPECT_EQ(bench_.Writes(), 0);
  ExpectRecovery();
}

TEST_F(Abuse, EventsOfAPermanentFaultArePaced) {
  Spoil(600.0, [](int, Sample* s) { s->overrun = true; });
  EXPECT_EQ(bench_.Writes(), 0);
  EXPECT_LE(bench_.events.size(), 16u);
  EXPECT_GE(bench_.Count(Code::kSampleGap), 8);
}

TEST_F(Abuse, SingleClippedSamplesAreCode9) {
  Spoil(20.0, [](int i, Sample* s) {
    s->gyro_clipped = i % 300 == 0;
    if (s->gyro_clipped) s->rate_dps[0] = 2000.0f;
  });
  EXPECT_GE(bench_.Count(Code::kClipped), 2);
  EXPECT_EQ(bench_.Writes(), 0);
  ExpectRecovery();
}

TEST_F(Abuse, SaturationEndsTheStill) {
  Spoil(5.0, [](int, Sample*) {});
  Spoil(5.0, [](int, Sample* s) {
    s->gyro_clipped = true;
    s->rate_dps[2] = 2000.0f;
  });
  EXPECT_FALSE(last_.still);
  EXPECT_THAT(bench_.Codes(), testing::ElementsAre(Code::kClipped));
  ExpectRecovery();
}

TEST_F(Abuse, DeadTemperatureSensorIsCode7AndTheLastValueServes) {
  const float before = bench_.corrector().table().At(25.0f).zro_dps[0];
  Spoil(7.0, [](int, Sample* s) { s->temp_degc = -273.0f; });
  EXPECT_GE(bench_.Count(Code::kTemperatureSensor), 1);
  EXPECT_NEAR(last_.zro_dps[0], before, 0.01f);
  ExpectRecovery();
}

TEST_F(Abuse, StuckGyroIsRefusedByTheTable) {
  Spoil(30.0, [](int, Sample* s) {
    for (float& rate : s->rate_dps) rate = 0.0f;
  });
  EXPECT_EQ(bench_.Writes(), 0);
  ExpectRecovery();
}

TEST_F(Abuse, DateSetBackLosesNothing) {
  bench_.corrector().SetDate(10);
  bench_.Rest(7.0, 25.0);
  EXPECT_EQ(bench_.Count(Code::kOverwroteOld), 1);  // dated ahead: redated by a confirming reading
  const int learned = bench_.table().InBin(25.0f, Origin::kLearned);
  ASSERT_GE(learned, 0);
  EXPECT_EQ(bench_.table()[learned].date, 10);
  ExpectRecovery();
}

TEST_F(Abuse, TestModeIsCode16) {
  bench_.corrector().SetTestMode(true);
  bench_.Rest(7.0, 30.0);
  EXPECT_EQ(bench_.Count(Code::kTestMode), 1);
  EXPECT_EQ(bench_.Writes(), 0);
  bench_.corrector().SetTestMode(false);
  ExpectRecovery();
}

TEST_F(Abuse, ReadingThatATestModeTouchedIsCode16EvenWhenItEndedInTime) {
  bench_.Rest(2.0, 30.0);
  bench_.corrector().SetTestMode(true);
  bench_.Rest(1.0, 30.0, {0.05, 0.0, 0.0});  // what the bench injects
  bench_.corrector().SetTestMode(false);
  bench_.Rest(3.5, 30.0);
  EXPECT_THAT(bench_.Codes(), testing::ElementsAre(Code::kTestMode));
  bench_.Rest(6.0, 30.0);
  EXPECT_THAT(bench_.Codes(), testing::ElementsAre(Code::kTestMode, Code::kNew));
}

TEST_F(Abuse, NewFactoryEntryDropsTheResidualOfTheTableBefore) {
  bench_.Rest(7.0, 25.0, {0.05, 0.0, 0.0});
  const float zro[3] = {};
  ASSERT_TRUE(bench_.corrector().AddFactoryEntry(60.0f, zro, 0.005f));
  last_ = bench_.Step(bench_.Make(Scene{}));
  EXPECT_FLOAT_EQ(last_.zro_dps[0], bench_.table().At(25.0f).zro_dps[0]);
}

TEST_F(Abuse, FadedResidualStaysGoneWhenTheSampleIndexWraps) {
  bench_.Rest(7.0, 25.0, {0.04, 0.0, 0.0});  // within the tolerance: held as residual
  bench_.Shake(1.0);
  bench_.Rest(7.0, 25.0, {-0.04, 0.0, 0.0});
  Limits limits;
  limits.mode = Mode::kApply;  // nothing new takes its place
  bench_.corrector().SetLimits(limits);
  const float table_dps = bench_.table().At(25.0f).zro_dps[0];
  last_ = bench_.Step(bench_.Make(Scene{}));
  EXPECT_GT(fabsf(last_.zro_dps[0] - table_dps), 0.005f);
  for (int half = 0; half < 2; ++half) {  // 2^32 samples: 248 days at 200 Hz
    Sample later = bench_.Make(Scene{});
    later.elapsed = 0x80000000u;
    last_ = bench_.Step(later);
    EXPECT_FLOAT_EQ(last_.zro_dps[0], table_dps);
  }
}

TEST_F(Abuse, OnlyLearnApplyLearns) {
  for (const Mode mode : {Mode::kOff, Mode::kApply, Mode::kFrozen}) {
    Limits limits;
    limits.mode = mode;
    bench_.corrector().SetLimits(limits);
    bench_.Rest(20.0, 30.0);
    last_ = bench_.Step(bench_.Make(Scene{30.0}));
    EXPECT_EQ(last_.zro_dps[0] == 0.0f, mode == Mode::kOff);
    EXPECT_FALSE(last_.learning);
  }
  EXPECT_TRUE(bench_.events.empty());
  bench_.corrector().SetLimits(Limits{});
  ExpectRecovery();
}

TEST_F(Abuse, SameInputsSameOutputs) {
  const auto run = [](std::vector<float>* out) {
    Bench bench(Config{}, 5);
    bench.AddFactory({10, 25, 40});
    for (int i = 0; i < 6; ++i) {
      bench.Run(
          9.0, [&](double t) { return Scene{20.0 + i + 0.05 * t}; },
          [&](const Scene&, const Output& o) { out->push_back(o.rate_dps[0]); });
      bench.Shake(1.0);
    }
  };
  std::vector<float> first, second;
  run(&first);
  run(&second);
  EXPECT_EQ(first, second);
}

TEST_F(Abuse, GarbageNeverMakesTheOffsetNonFinite) {
  const float garbage[] = {0.0f,
                           1.0f,
                           -1e30f,
                           1e30f,
                           2000.0f,
                           25.0f,
                           std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::denorm_min()};
  std::mt19937 rng(9);
  const auto pick = [&] { return garbage[rng() % std::size(garbage)]; };
  Spoil(120.0, [&](int i, Sample* s) {
    if (i % 1500 > 200) return;  // bursts, with time to become still between them
    for (int axis = 0; axis < 3; ++axis) s->rate_dps[axis] = pick(), s->accel_g[axis] = pick();
    s->temp_degc = pick();
    s->elapsed =
        rng() % 50 == 0 ? static_cast<std::uint32_t>(rng()) : static_cast<std::uint32_t>(rng() % 3);
    s->overrun = rng() % 2 == 0;
  });
  for (const float zro : last_.zro_dps) EXPECT_LT(std::abs(zro), 12.0f);
  EXPECT_EQ(bench_.Count(Code::kQuarantined), 0);
  ExpectRecovery();
}

TEST_F(Abuse, LostEventsAreCounted) {
  RecordProperty("capacity", EventQueue::kCapacity);
  EventQueue queue;
  for (int i = 0; i < EventQueue::kCapacity + 3; ++i) queue.Push(Event{});
  Event event;
  ASSERT_TRUE(queue.Pop(&event));
  EXPECT_EQ(event.seq, 3u);
  EXPECT_EQ(queue.lost(), 3u);
}

}  // namespace
}  // namespace zro
