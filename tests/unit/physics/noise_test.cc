#include "rig/physics/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/physics/random.h"
#include "tests/unit/physics/spectrum.h"

namespace zrobench::physics {
namespace {

double Decibel(double power_ratio) { return 10 * std::log10(power_ratio); }

TEST(RandomStream, KnownWords) {
  // From the authors' reference code for splitmix64 and xoshiro256++, written out independently.
  RandomStream stream(1, 0);
  EXPECT_EQ(stream.Next(), 0x4887886c7244e091u);
  EXPECT_EQ(stream.Next(), 0x4cfafb3b6cc3ea99u);
  EXPECT_EQ(stream.Next(), 0xfbce21167403a2c1u);
}

TEST(RandomStream, NormalsHaveTheSameBitsInEveryBuild) {
  RandomStream stream(20260101, 3);
  double sum = 0;  // a fixed order of additions: one differing bit shows
  for (int i = 0; i < 100000; ++i) sum += stream.Normal();
  EXPECT_EQ(sum, 0x1.7d5a9d7ed8583p+6);
}

TEST(RandomStream, NormalsAreNormal) {
  RandomStream stream(7, 1);
  constexpr int kN = 4'000'000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0, low = 0, high = 0;
  std::vector<int> beyond(6);
  for (int i = 0; i < kN; ++i) {
    const double x = stream.Normal();
    m1 += x, m2 += x * x, m3 += x * x * x, m4 += x * x * x * x;
    for (std::size_t k = 0; k < beyond.size(); ++k)
      beyond[k] += std::fabs(x) > static_cast<double>(k);
    low = std::min(low, x), high = std::max(high, x);
  }
  EXPECT_LT(low, -4.5);
  EXPECT_GT(high, 4.5);
  const double error = 1 / std::sqrt(kN);  // of the mean; moments' own errors: times 1.4, 3.9, 9.8
  EXPECT_NEAR(m1 / kN, 0, 4 * error);
  EXPECT_NEAR(m2 / kN, 1, 4 * 1.42 * error);
  EXPECT_NEAR(m3 / kN, 0, 4 * 3.88 * error);
  EXPECT_NEAR(m4 / kN, 3, 4 * 9.80 * error);
  for (std::size_t k = 0; k < beyond.size(); ++k) {
    const double expected = std::erfc(static_cast<double>(k) / std::sqrt(2)) * kN;
    EXPECT_NEAR(beyond[k], expected, 4 * std::sqrt(expected) + 1) << "beyond " << k << " sigma";
  }
}

TEST(RandomStream, StreamsAndSeedsAreUncorrelated) {
  RandomStream a(5, 0), b(5, 1), c(6, 0);
  double ab = 0, ac = 0;
  constexpr int kN = 100000;
  for (int i = 0; i < kN; ++i) {
    const double x = a.Normal();
    ab += x * b.Normal();
    ac += x * c.Normal();
  }
  EXPECT_LT(std::fabs(ab) / kN, 4 / std::sqrt(kN));
  EXPECT_LT(std::fabs(ac) / kN, 4 / std::sqrt(kN));
}

TEST(WhiteNoise, HasItsDensity) {
  const double sigma = WhiteSigma(0.005, 200);
  EXPECT_DOUBLE_EQ(sigma, 0.05);
  RandomStream stream(3, 0);
  std::vector<double> x(1 << 18);
  for (double& value : x) value = sigma * stream.Normal();
  for (const std::size_t cycles : {4, 20, 100}) {
    EXPECT_NEAR(Decibel(Density(x, 200, 256, cycles) / (0.005 * 0.005)), 0, 0.3) << cycles;
  }
}

class Flicker : public testing::Test {
 protected:
  static constexpr double kB = 0.002, kHz = 100;
  /// 11.6 h at 100 Hz.
  static const std::vector<double>& Samples() {
    static const std::vector<double> samples = [] {
      FlickerNoise noise(kB, kHz, 11, 6);
      std::vector<double> x(1 << 22);
      for (double& value : x) value = noise.Next();
      return x;
    }();
    return samples;
  }
  static double Expected(double hz) { return kB * kB / (2 * std::numbers::pi * hz); }
};

TEST_F(Flicker, FollowsOneOverFOverFiveDecades) {
  // (averaged by, segment, cycles): 5 mHz steps down by averaging, so that each estimate is cheap.
  // A mean of N samples damps a frequency f by sinc(f N / sample_hz), divided out.
  struct Point {
    std::size_t by, length, cycles;
  };
  std::vector<double> log_f, log_s;
  for (const Point p : {Point{1, 256, 110}, Point{1, 256, 50}, Point{1, 256, 8}, Point{16, 256, 32},
                        Point{16, 256, 6}, Point{256, 256, 24}, Point{256, 256, 5},
                        Point{2048, 256, 12}, Point{2048, 256, 4}}) {
    const double hz = kHz / static_cast<double>(p.by);
    const std::size_t spread = 5;
    double expected = 0;
    for (std::size_t k = p.cycles; k < p.cycles + spread; ++k) {
      const double f = hz * static_cast<double>(k) / static_cast<double>(p.length);
      const double arc = std::numbers::pi * f / hz;
      const double damped = p.by == 1 ? 1 : std::sin(arc) / arc;
      expected += Expected(f) * damped * damped / static_cast<double>(spread);
    }
    const double f = hz * static_cast<double>(p.cycles + 2) / static_cast<double>(p.length);
    const double off_db =
        Decibel(Density(Averaged(Samples(), p.by), hz, p.length, p.cycles) / expected);
    EXPECT_NEAR(off_db, 0, 1.0) << "at " << f << " Hz";
    log_f.push_back(std::log10(f));
    log_s.push_back(off_db / 10 + std::log10(Expected(f)));
  }
  EXPECT_GT(log_f.front() - log_f.back(), 4);
  double mf = 0, ms = 0, sff = 0, sfs = 0;
  const double n = static_cast<double>(log_f.size());
  for (std::size_t i = 0; i < log_f.size(); ++i) mf += log_f[i] / n, ms += log_s[i] / n;
  for (std::size_t i = 0; i < log_f.size(); ++i) {
    sff += (log_f[i] - mf) * (log_f[i] - mf);
    sfs += (log_f[i] - mf) * (log_s[i] - ms);
  }
  EXPECT_NEAR(sfs / sff, -1, 0.02);
}

TEST_F(Flicker, DesignKeepsItsStatedRipple) {
  for (const double sample_hz : {1.0, 50.0, 200.0, 1000.0}) {
    const FlickerNoise noise(kB, sample_hz, 1, 0);
    for (double hz = sample_hz / 2; hz > 1.0 / 86400; hz *= 0.97) {
      const double off_db = Decibel(noise.Density(hz) / Expected(hz));
      const bool inner = hz < sample_hz / 1000 && hz > 10.0 / 86400;
      EXPECT_NEAR(off_db, 0, inner ? 0.1 : 0.7) << hz << " Hz of " << sample_hz << " Hz";
    }
  }
}

TEST_F(Flicker, AllanDeviationIsFlatAtTheFloor) {
  // sigma^2 = 2 ln 2 h_-1 for S = h_-1 / f (IEEE 1139); here h_-1 = B^2 / (2 pi).
  const double floor_dps = kB * std::sqrt(std::numbers::ln2 / std::numbers::pi);
  for (const std::size_t by : {10, 100, 1000, 10000}) {
    EXPECT_NEAR(AllanDeviation(Samples(), by) / floor_dps, 1, 0.07) << by << " samples";
  }
}

TEST_F(Flicker, StartsInItsStationaryLaw) {
  // Over many seeds the first sample scatters as much as one an hour later. The bank has 13
  // processes of variance B^2 ln 4 / (2 pi) at 1 Hz.
  double first = 0, later = 0;
  constexpr int kSeeds = 400;
  for (int seed = 0; seed < kSeeds; ++seed) {
    FlickerNoise noise(1, 1, static_cast<std::uint64_t>(seed), 0);
    const double x = noise.Next();
    first += x * x;
    double y = 0;
    for (int i = 0; i < 3600; ++i) y = noise.Next();
    later += y * y;
  }
  EXPECT_NEAR(later / first, 1, 0.35);
  EXPECT_NEAR(first / kSeeds / (std::log(4) / (2 * std::numbers::pi)), 10, 2.5);
}

TEST_F(Flicker, SizeScalesAndZeroIsSilent) {
  FlickerNoise one(1, 50, 9, 2), two(2, 50, 9, 2), none(0, 50, 9, 2);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(two.Next(), 2 * one.Next());
    EXPECT_EQ(none.Next(), 0);
  }
}

}  // namespace
}  // namespace zrobench::physics
