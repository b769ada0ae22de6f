#include "corrector/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace zro {
namespace {

constexpr float kHz = 200.0f;

/// Fills a reading of 1000 samples; `touch` may spoil each.
template <typename Touch>
Summary Read(Touch touch) {
  std::mt19937 rng(3);
  std::normal_distribution<float> normal;
  Reading reading(kHz);
  reading.Restart(1000);
  for (int i = 0; !reading.ripe() && i < 5000; ++i) {
    Sample s{};
    for (float& rate : s.rate_dps) rate = 0.4f + 0.05f * normal(rng);
    s.temp_degc = 25.0f;
    s.elapsed = 1;
    touch(i, &s);
    reading.Add(s, s.temp_degc, IsPhysicalTemperature(s.temp_degc));
  }
  return reading.Summarise();
}

Finding Assess(const Summary& summary) {
  return AssessQuality(summary, Limits{}, NoiseFloor(0.005f, kHz));
}

TEST(Quality, CleanReadingPassesWithItsStatistics) {
  const Summary s = Read([](int, Sample*) {});
  EXPECT_EQ(Assess(s).code, Code::kNone);
  EXPECT_NEAR(s.zro_dps[0], 0.4f, 0.008f);
  EXPECT_NEAR(s.std_dps[0], 0.05f, 0.005f);
  EXPECT_NEAR(s.sigma_dps, 0.0026f, 0.0004f);
  EXPECT_EQ(s.samples, 1000u);
}

TEST(Quality, RampWithinTheLimitPassesAndItsSlopeIsRight) {
  const auto ramp = [](float rate) {
    return Read([rate](int i, Sample* s) {
      s->temp_degc = 25.0f + rate * static_cast<float>(i / 10 * 10) / kHz;
    });
  };
  EXPECT_EQ(Assess(ramp(5.0f / 60.0f)).code, Code::kNone);
  EXPECT_NEAR(ramp(5.0f / 60.0f).slope_degc_per_s, 5.0f / 60.0f, 0.002f);
  const Finding steep = Assess(ramp(0.2f));
  EXPECT_EQ(steep.code, Code::kTemperatureSlope);
  EXPECT_NEAR(steep.value, 0.2f, 0.005f);
}

TEST(Quality, OneLostSampleOrOverrunIsAGap) {
  EXPECT_EQ(Assess(Read([](int i, Sample* s) { s->elapsed = i == 500 ? 2 : 1; })).code,
            Code::kSampleGap);
  EXPECT_EQ(Assess(Read([](int i, Sample* s) { s->overrun = i == 7; })).code, Code::kSampleGap);
}

TEST(Quality, NanRateIsMissingNotAveraged) {
  const Summary s = Read([](int i, Sample* x) {
    if (i == 100) x->rate_dps[0] = NAN;
  });
  EXPECT_EQ(Assess(s).code, Code::kSampleGap);
  EXPECT_TRUE(std::isfinite(s.zro_dps[0]));
}

TEST(Quality, OneClippedSampleSpoilsTheMean) {
  EXPECT_EQ(Assess(Read([](int i, Sample* s) { s->gyro_clipped = i == 3; })).code, Code::kClipped);
  EXPECT_EQ(Assess(Read([](int i, Sample* s) { s->accel_clipped = i == 3; })).code, Code::kClipped);
}

TEST(Quality, TemperatureSensorMustGivePhysicalSteadyNumbers) {
  for (const float bad : {NAN, INFINITY, -100.0f, 300.0f, 45.0f}) {
    const Summary s = Read([bad](int i, Sample* x) {
      if (i >= 490 && i < 500) x->temp_degc = bad;
    });
    EXPECT_EQ(Assess(s).code, Code::kTemperatureSensor) << bad;
  }
}

TEST(Quality, TemperatureRange) {
  const Finding hot = Assess(Read([](int, Sample* s) { s->temp_degc = 86.0f; }));
  EXPECT_EQ(hot.code, Code::kTemperatureRange);
  EXPECT_NEAR(hot.value, 86.0f, 1e-3f);
  EXPECT_FLOAT_EQ(hot.limit, 85.0f);
  EXPECT_EQ(Assess(Read([](int, Sample* s) { s->temp_degc = -41.0f; })).code,
            Code::kTemperatureRange);
}

TEST(Quality, BiasLimitNamesTheAxis) {
  const Finding f = Assess(Read([](int, Sample* s) { s->rate_dps[1] -= 13.0f; }));
  EXPECT_EQ(f.code, Code::kBiasLimit);
  EXPECT_EQ(f.axis, 1);
}

TEST(Quality, DriftWithinTheWindowIsGyroVariance) {
  const Finding f = Assess(Read([](int i, Sample* s) { s->rate_dps[2] += i < 500 ? 0.0f : 0.1f; }));
  EXPECT_EQ(f.code, Code::kGyroVariance);
  EXPECT_EQ(f.axis, 2);
}

TEST(Quality, NoiseIsJudgedAgainstTheLearnedFloor) {
  NoiseFloor floor(0.005f, kHz);
  floor.Learn(Read([](int, Sample*) {}));
  const auto noisier = [](float factor) {
    return Read([factor](int, Sample* s) {
      for (float& r : s->rate_dps) r = 0.4f + factor * (r - 0.4f);
    });
  };
  EXPECT_EQ(AssessQuality(noisier(1.2f), Limits{}, floor).code, Code::kNone);
  const Finding tone = AssessQuality(noisier(1.5f), Limits{}, floor);
  EXPECT_EQ(tone.code, Code::kAcousticOrVibration);
  EXPECT_NEAR(tone.value, 1.5f, 0.02f);
  EXPECT_EQ(AssessQuality(noisier(4.0f), Limits{}, floor).code, Code::kGyroVariance);
}

TEST(Quality, FloorFollowsDownFastAndUpSlowly) {
  NoiseFloor floor(0.005f, kHz);
  Summary s{};
  const auto learn = [&](float std_dps) {
    for (float& x : s.std_dps) x = std_dps;
    floor.Learn(s);
  };
  learn(0.05f);
  learn(0.065f);
  EXPECT_GT(floor.Ratio(0.0675f, 0), 1.3f);
  learn(0.03f);
  EXPECT_GT(floor.Ratio(0.0585f, 0), 1.4f);
}

TEST(Quality, AnAxisThatWasStuckOnceDoesNotLockOutWhatComesAfter) {
  NoiseFloor floor(0.005f, kHz);
  floor.Learn(Read([](int, Sample* s) { s->rate_dps[1] = 0.0f; }));
  EXPECT_EQ(AssessQuality(Read([](int, Sample*) {}), Limits{}, floor).code, Code::kNone);
  floor.Learn(Read([](int, Sample*) {}));
  for (int i = 0; i < 20; ++i) {
    floor.Learn(Read([](int, Sample* s) {
      for (float& rate : s->rate_dps) rate = 0.0f;
    }));
  }
  EXPECT_EQ(AssessQuality(Read([](int, Sample*) {}), Limits{}, floor).code, Code::kNone);
}

TEST(Quality, PresentNoiseSeesAToneNotASlope) {
  std::mt19937 rng(3);
  std::normal_distribution<float> normal;
  PresentNoise noise(kHz);
  for (int i = 0; i < 2000; ++i) {
    const float rate = 0.01f * static_cast<float>(i) + 0.05f * normal(rng);
    const float rates[3] = {rate, rate, rate};
    noise.Add(rates);
  }
  EXPECT_NEAR(sqrtf(noise.Variance(0)), 0.05f, 0.012f);
}

}  // namespace
}  // namespace zro
