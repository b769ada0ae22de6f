#include "corrector/stillness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace zro {
namespace {

constexpr float kHz = 200.0f;
constexpr float kLimitG = 0.015f;

class StillnessTest : public testing::Test {
 protected:
  Sample Quiet() {
    Sample s{};
    for (int i = 0; i < 3; ++i) {
      s.rate_dps[i] = 0.5f + 0.05f * normal_(rng_);
      s.accel_g[i] = (i == 2 ? 1.0f : 0.0f) + accel_noise_g_ * normal_(rng_);
    }
    s.elapsed = 1;
    return s;
  }
  int Feed(int n) {
    int ended = 0;
    for (int i = 0; i < n; ++i) ended += stillness_.Step(Quiet(), kLimitG) ? 1 : 0;
    return ended;
  }

  float accel_noise_g_ = 0.002f;
  std::mt19937 rng_{1};
  std::normal_distribution<float> normal_;
  Stillness stillness_{kHz};
};

TEST_F(StillnessTest, NeedsSeveralSeconds) {
  Feed(399);
  EXPECT_FALSE(stillness_.still());
  Feed(1);
  EXPECT_TRUE(stillness_.still());
}

TEST_F(StillnessTest, HoldsForHoursUnderSensorNoise) {
  accel_noise_g_ = 0.005f;
  EXPECT_EQ(Feed(200 * 3600), 0);
  EXPECT_TRUE(stillness_.still());
}

TEST_F(StillnessTest, MonthsOfRestCannotWrapTheCount) {
  Feed(200 * 60);
  EXPECT_EQ(stillness_.quiet_samples(), 400u);  // no more than the 2 s that anyone asks about
}

TEST_F(StillnessTest, OneInterruptionForALongMotion) {
  Feed(1000);
  int ended = 0;
  for (int i = 0; i < 2000; ++i) {
    Sample s = Quiet();
    s.accel_g[0] += 0.1f * std::sin(0.05f * static_cast<float>(i));
    ended += stillness_.Step(s, kLimitG) ? 1 : 0;
  }
  EXPECT_EQ(ended, 1);
  EXPECT_FALSE(stillness_.still());
  EXPECT_EQ(stillness_.interruption().code, Code::kMotion);
  EXPECT_EQ(stillness_.interruption().axis, 0);
  EXPECT_GT(stillness_.interruption().value, stillness_.interruption().limit);
}

TEST_F(StillnessTest, GyroSeesTheTurnTheAccelerometerCannot) {
  Feed(1000);
  int ended = 0;
  for (int i = 0; i < 40; ++i) {
    Sample s = Quiet();
    s.rate_dps[2] += 3.0f;  // about gravity
    ended += stillness_.Step(s, kLimitG) ? 1 : 0;
  }
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(stillness_.interruption().axis, 2);
  EXPECT_FLOAT_EQ(stillness_.interruption().limit, Stillness::kTurnDps);
}

TEST_F(StillnessTest, SlowTiltIsMotion) {
  Feed(1000);
  int ended = 0;
  for (int i = 0; i < 1000; ++i) {  // 2 deg/s about x turns gravity by 35 mg a second
    Sample s = Quiet();
    s.accel_g[1] += std::sin(static_cast<float>(i) * 2.0f / kHz * 0.0174533f);
    ended += stillness_.Step(s, kLimitG) ? 1 : 0;
  }
  EXPECT_GE(ended, 1);
}

TEST_F(StillnessTest, NanIsShortlyIgnoredAndNeverRemembered) {
  Feed(1000);
  Sample bad = Quiet();
  bad.rate_dps[1] = NAN;
  bad.accel_g[0] = INFINITY;
  EXPECT_FALSE(stillness_.Step(bad, kLimitG));
  EXPECT_TRUE(stillness_.still());
  int ended = 0;
  for (int i = 0; i < 100; ++i) ended += stillness_.Step(bad, kLimitG) ? 1 : 0;
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(stillness_.interruption().code, Code::kSampleGap);
  Feed(500);
  EXPECT_TRUE(stillness_.still());
}

TEST_F(StillnessTest, LongGapEndsIt) {
  Feed(1000);
  Sample late = Quiet();
  late.elapsed = 100;
  EXPECT_TRUE(stillness_.Step(late, kLimitG));
  EXPECT_EQ(stillness_.interruption().code, Code::kSampleGap);
}

}  // namespace
}  // namespace zro
