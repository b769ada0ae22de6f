#include "rig/diagnose/gyro_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/physics/noise.h"
#include "rig/physics/random.h"

namespace zrobench::diagnose {
namespace {

constexpr double kBlock_s = 5;
constexpr double kDensity = 0.005, kFlicker = 0.002;

/// Block means of the rig's own noise, sampled at 10 Hz.
Eigen::ArrayXd RigNoise(Eigen::Index blocks, std::uint64_t seed) {
  physics::RandomStream white(seed, 0);
  physics::FlickerNoise flicker(kFlicker, 10, seed, 1);
  const double sigma = physics::WhiteSigma(kDensity, 10);
  Eigen::ArrayXd means = Eigen::ArrayXd::Zero(blocks);
  for (double& mean : means) {
    for (int i = 0; i < 50; ++i) mean += (sigma * white.Normal() + flicker.Next()) / 50;
  }
  return means;
}

double Autocorrelation(const Eigen::ArrayXd& x, Eigen::Index lag) {
  return (x.head(x.size() - lag) * x.tail(x.size() - lag)).mean() / x.square().mean();
}

GyroNoise Stated() {
  physics::GyroModel gyro;
  gyro.noise_density_dps_per_rthz = kDensity;
  gyro.flicker_dps = kFlicker;
  return GyroNoise::Nominal(gyro, kBlock_s);
}

TEST(NoiseWhitener, TheRigsNoiseComesOutWhiteWithUnitVariance) {
  const Eigen::ArrayXd noise = RigNoise(20000, 3);
  const NoiseWhitener whitener(Stated(), kBlock_s, std::vector<bool>(20000, true));
  const Eigen::ArrayXd white = whitener.Whiten(noise);
  EXPECT_NEAR(white.square().mean(), 1, 0.08);
  for (const Eigen::Index lag : {1, 2, 10, 100}) {
    EXPECT_NEAR(Autocorrelation(white, lag), 0, 0.06) << "lag " << lag;
    EXPECT_GT(Autocorrelation(noise, lag), 0.2) << "the test has nothing to whiten";
  }
}

TEST(NoiseWhitener, IsLinear) {
  const NoiseWhitener whitener(Stated(), kBlock_s, std::vector<bool>(500, true));
  const Eigen::ArrayXd a = RigNoise(500, 4), b = RigNoise(500, 5);
  const Eigen::ArrayXd together = whitener.Whiten(a + 3 * b);
  EXPECT_LT((together - whitener.Whiten(a) - 3 * whitener.Whiten(b)).abs().maxCoeff(), 1e-9);
}

TEST(NoiseWhitener, AGapGivesNothingAndTheSlowNoiseGoesOn) {
  Eigen::ArrayXd noise = RigNoise(4000, 6);
  std::vector<bool> measured(4000, true);
  for (std::size_t i = 1000; i < 1200; ++i) {
    measured[i] = false;
    noise[static_cast<Eigen::Index>(i)] = std::nan("");
  }
  const Eigen::ArrayXd white = NoiseWhitener(Stated(), kBlock_s, measured).Whiten(noise);
  EXPECT_TRUE(white.allFinite());
  EXPECT_EQ(white.segment(1000, 200).abs().maxCoeff(), 0);
  EXPECT_NEAR(white.tail(2800).square().mean(), 1, 0.1);
}

}  // namespace
}  // namespace zrobench::diagnose
