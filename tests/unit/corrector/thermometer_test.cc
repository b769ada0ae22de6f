#include "corrector/thermometer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace zro {
namespace {

constexpr float kHz = 10.0f;

/// Greatest error from `from_s` on of what is made of a sensor with steps of `step_degc`.
template <typename Curve>
double WorstError(double step_degc, double from_s, double to_s, Curve curve) {
  std::mt19937 rng(5);
  std::normal_distribution<double> noise(0.0, 0.02);
  Thermometer thermometer(kHz);
  double worst = 0.0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(to_s * 10.0); ++i) {
    const double t = i / 10.0;
    const double shown = step_degc * std::round((curve(t) + noise(rng)) / step_degc);
    const auto taken = static_cast<double>(thermometer.Take(static_cast<float>(shown), i));
    if (t >= from_s) worst = std::max(worst, std::abs(taken - curve(t)));
    EXPECT_LE(std::abs(taken - shown), 0.5 * step_degc + 1e-4);  // what the sensor shows holds
  }
  return worst;
}

TEST(Thermometer, FineSensorPassesUnchanged) {
  Thermometer thermometer(kHz);
  float shown = 20.0f;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    shown += i % 3 == 0 ? -1.0f / 256.0f : 2.0f / 256.0f;
    EXPECT_EQ(thermometer.Take(shown, i), shown);
  }
}

TEST(Thermometer, WholeDegreesOnARampAreKnownToASixth) {
  EXPECT_LT(WorstError(1.0, 300.0, 1200.0, [](double t) { return 20.3 + 0.02 * t; }), 0.16);
  EXPECT_LT(WorstError(1.0, 300.0, 1200.0, [](double t) { return 60.3 - 0.02 * t; }), 0.16);
}

TEST(Thermometer, ASlowTurnIsCarriedOn) {
  const auto wave = [](double t) { return 30.0 - 12.0 * std::cos(6.2832 * t / 3600.0); };
  EXPECT_LT(WorstError(1.0, 600.0, 7200.0, wave), 0.45);
  EXPECT_LT(WorstError(0.125, 600.0, 7200.0, wave), 0.1);
}

TEST(Thermometer, RestSettlesOnWhatIsShown) {
  const auto stops = [](double t) { return t < 500.0 ? 20.0 + 0.02 * t : 30.0; };
  EXPECT_LT(WorstError(1.0, 1000.0, 2000.0, stops), 0.01);
}

TEST(Thermometer, AJumpIsNoCrossing) {
  Thermometer thermometer(kHz);
  for (std::uint32_t i = 0; i < 100; ++i) thermometer.Take(20.0f + static_cast<float>(i / 50), i);
  EXPECT_EQ(thermometer.Take(40.0f, 100), 40.0f);
}

}  // namespace
}  // namespace zro
