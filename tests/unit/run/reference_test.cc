#include "rig/run/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace zrobench {
namespace {

/// A ramp from 20 to 30 degC at `rate`; offsets are lines in temperature plus white noise.
Evidence Ramp(double rate_degc_per_s, double noise_dps, std::uint32_t seed) {
  Evidence evidence;
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, noise_dps);
  for (int s = 1; 20 + rate_degc_per_s * s < 30; ++s) {
    MeanItem mean{.at_us = static_cast<std::uint64_t>(s) * 1'000'000};
    mean.imu_degc = static_cast<float>(20 + rate_degc_per_s * s);
    for (std::size_t a = 0; a < 3; ++a) {
      mean.raw_dps[a] = static_cast<float>(0.5 + 0.03 * (mean.imu_degc - 25) + noise(generator));
    }
    evidence.seconds.push_back({mean, true});
  }
  return evidence;
}

TEST(Reference, FollowsTheSlopeOfARamp) {
  const auto reference = ReferenceAt(Ramp(0.05, 0, 1), 24.0);
  ASSERT_TRUE(reference);
  EXPECT_NEAR(reference->zro_dps[0], 0.47, 1e-5);
  EXPECT_NEAR(reference->uncertainty_k2_dps[0], 0, 1e-5);
}

TEST(Reference, ItsUncertaintyCoversTheErrorInNineteenOfTwentyRuns) {
  int covered = 0, total = 0;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    const auto reference = ReferenceAt(Ramp(0.05, 0.004, seed), 24.0);
    ASSERT_TRUE(reference);
    for (std::size_t a = 0; a < 3; ++a, ++total) {
      covered += std::abs(reference->zro_dps[a] - 0.47) <= reference->uncertainty_k2_dps[a];
    }
  }
  EXPECT_GE(covered, total * 92 / 100);
  EXPECT_LE(covered, total * 99 / 100);  // and is not simply huge
}

TEST(Reference, ALongSoakDoesNotDrownTheRampBesideIt) {
  Evidence evidence = Ramp(0.05, 0, 1);  // 20 s a degree
  Second soak = evidence.seconds[93];    // at 24.7 degC
  std::vector<Second>& seconds = evidence.seconds;
  seconds.resize(110);  // the ramp ends at 25.5 degC
  seconds.insert(seconds.begin() + 94, 1000, soak);
  const auto reference = ReferenceAt(evidence, 25.4);
  ASSERT_TRUE(reference);
  EXPECT_NEAR(reference->zro_dps[0], 0.512, 1e-4);
}

TEST(Reference, SecondsThatAreNotQuietDoNotCount) {
  Evidence evidence = Ramp(0.05, 0, 1);
  for (Second& second : evidence.seconds) {
    if (second.mean.imu_degc < 24) continue;
    second.mean.raw_dps = {9, 9, 9};
    second.quiet = false;
  }
  const auto reference = ReferenceAt(evidence, 23.8);
  ASSERT_TRUE(reference);
  EXPECT_NEAR(reference->zro_dps[0], 0.464, 1e-4);
}

TEST(Reference, SaysNothingWhereThereIsNoDataOrOnlyOneSide) {
  EXPECT_FALSE(ReferenceAt(Ramp(0.05, 0, 1), 35.0));
  EXPECT_FALSE(ReferenceAt(Ramp(0.05, 0, 1), 30.8));
  EXPECT_FALSE(ReferenceAt(Evidence{}, 25.0));
}

}  // namespace
}  // namespace zrobench
