// Accuracy in mdps on known truths: what the whole is for.
#include <gtest/gtest.h>

#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using test::Bench;
using test::Scene;
using test::TrueOffset;

constexpr double kPi = 3.14159265358979;

/// RMS and greatest error of the offset subtracted, over all samples fed.
struct Error {
  double squares = 0.0, max = 0.0;
  int n = 0;
  void Add(const Scene& scene, const Output& out) {
    double e2 = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double e = static_cast<double>(out.zro_dps[i]) - TrueOffset(scene.temp_degc)[i];
      e2 += e * e;
    }
    squares += e2;
    max = std::max(max, std::sqrt(e2));
    ++n;
  }
  double Rms() const { return std::sqrt(squares / n); }
};

Config At100Hz() {
  Config config;
  config.sample_hz = 100.0f;
  config.limits.min_samples = 500;
  return config;
}

/// Two hours: 18 to 42 degC and back twice, still for 20 s of each minute.
Error Cycle(Bench& bench, bool slow_rotation, bool tone) {
  Error error;
  bench.noise.temp_degc = 0.02;
  bench.Run(
      7200.0,
      [&](double t) {
        const int minute = static_cast<int>(t / 60.0);
        const double in_minute = t - 60.0 * minute;
        Scene scene{30.0 + 12.0 * std::sin(2.0 * kPi * t / 3600.0 - kPi / 2.0)};
        scene.shaken = in_minute >= 20.0;
        if (scene.shaken) return scene;
        if (slow_rotation && minute % 3 == 1) scene.extra_dps[2] = 0.5;
        if (tone && minute % 6 == 2) scene = {scene.temp_degc, {0.3, -0.2, 0.0}, 1.5, false};
        return scene;
      },
      [&](const Scene& scene, const Output& out) {
        if (bench.t_s > 300.0) error.Add(scene, out);
      });
  return error;
}

TEST(Accuracy, TemperatureCycleFromFactoryEntries) {
  Bench bench(At100Hz());
  bench.AddFactory({20, 25, 30}, 0.010);
  const Error error = Cycle(bench, false, false);
  EXPECT_LT(error.Rms(), 0.004);
  EXPECT_LT(error.max, 0.025);
}

TEST(Accuracy, TemperatureCycleFromNothing) {
  Bench bench(At100Hz());
  const Error error = Cycle(bench, false, false);
  EXPECT_LT(error.Rms(), 0.010);
}

TEST(Accuracy, SlowRotationInEveryThirdStillChangesNothing) {
  Bench bench(At100Hz());
  bench.AddFactory({20, 25, 30}, 0.010);
  const Error error = Cycle(bench, true, false);
  EXPECT_LT(error.Rms(), 0.005);
  EXPECT_EQ(bench.Count(Code::kShiftConfirmed), 0);
}

TEST(Accuracy, ToneInEverySixthStillChangesNothing) {
  Bench bench(At100Hz());
  bench.AddFactory({20, 25, 30}, 0.010);
  EXPECT_LT(Cycle(bench, false, true).Rms(), 0.005);
}

class Ramp : public testing::TestWithParam<double> {};

TEST_P(Ramp, LearnsTheWholeRangeInOnePass) {
  const double rate = GetParam() / 60.0;
  Config config;
  Bench bench(config);
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  const double from = rate > 0.0 ? 0.0 : 50.0;
  bench.Run(50.0 / std::abs(rate), [&](double t) { return Scene{from + rate * t}; });
  for (double t = 0.0; t <= 50.0; t += 0.5) EXPECT_LT(bench.ErrorAt(t), 0.012) << t;
  EXPECT_EQ(bench.Count(Code::kNew), 20);
  EXPECT_TRUE(bench.corrector().complete());
  EXPECT_EQ(bench.Count(Code::kRetry), 0);
}

INSTANTIATE_TEST_SUITE_P(Rates, Ramp, testing::Values(5.0, -5.0, 2.0));

TEST(Accuracy, EveryCleanReadingOverTheRangeIsLetInByThreeFactoryEntries) {
  for (double temp = 0.0; temp <= 50.0; temp += 1.0) {
    Bench bench(Config{}, static_cast<std::uint64_t>(temp) + 10);
    bench.AddFactory({10, 25, 40});
    bench.Rest(6.5, temp);
    EXPECT_EQ(bench.Count(Code::kNew), 1) << temp;
  }
}

TEST(Accuracy, EveryShiftedReadingNearTheFactoryEntriesIsKeptOut) {
  for (const double shift : {0.2, -0.2}) {
    for (double temp = 4.0; temp <= 46.0; temp += 2.0) {
      Bench bench(Config{}, static_cast<std::uint64_t>(temp) + 10);
      bench.AddFactory({10, 25, 40});
      bench.Rest(6.5, temp, {shift, 0.0, 0.0});
      EXPECT_EQ(bench.Writes(), 0) << temp;
    }
  }
}

TEST(Accuracy, ResidualFollowsHysteresisThatNoTableCanHold) {
  Bench bench(At100Hz());
  bench.corrector().SetDate(15000);
  bench.AddFactory({20, 25, 30}, 0.0);
  double squares = 0.0;
  int n = 0;
  for (int cycle = 0; cycle < 6; ++cycle) {
    const double extra = cycle % 2 == 0 ? 0.02 : -0.02;
    bench.Rest(20.0, 25.0, {extra, 0, 0});
    bench.Run(
        60.0,
        [&](double) {
          return Scene{25.5, {extra, 0, 0}};
        },
        [&](const Scene&, const Output& out) {
          if (cycle < 2) return;
          const double e = static_cast<double>(out.zro_dps[0]) - TrueOffset(25.5)[0] - extra;
          squares += e * e;
          ++n;
        });
    bench.Shake(5.0);
  }
  EXPECT_LT(std::sqrt(squares / n), 0.010);  // half of what the mean over both would leave
}

TEST(Accuracy, LowSampleRatesLearnToo) {
  Config config;
  config.sample_hz = 30.0f;
  config.limits.min_samples = 150;
  Bench bench(config);  // 0.05 dps a sample, unfiltered: 2.6 times what the density promises
  bench.AddFactory({10, 25, 40});
  bench.Rest(20.0);
  EXPECT_EQ(bench.Count(Code::kNew), 1);
}

class AnyRate : public testing::TestWithParam<float> {};

TEST_P(AnyRate, LearnsInTheSameSeconds) {
  const float hz = GetParam();
  Bench bench(ConfigFor(hz, 0.005f));
  bench.noise.gyro_dps = 0.005 * std::sqrt(0.5 * static_cast<double>(hz));
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  for (const double temp : {18.0, 21.0, 24.0, 27.0}) {
    bench.Rest(6.5, temp);
    bench.Shake(2.0, temp);
    bench.Run(10.0, [temp](double) { return Scene{temp, {0.3, 0.0, 0.0}, 1.6}; });  // a tone
    bench.Shake(2.0, temp);
  }
  EXPECT_EQ(bench.Count(Code::kNew), 4);
  EXPECT_EQ(bench.Writes(), 4);
  EXPECT_LT(bench.ErrorAt(22.5), 0.012);
}

INSTANTIATE_TEST_SUITE_P(Hz, AnyRate, testing::Values(25.0f, 100.0f, 400.0f, 1000.0f));

TEST(Accuracy, WindowsOfAnyLengthLearn) {
  for (const int samples : {0, 2, 100, 65535}) {
    Config config;
    config.sample_hz = 1000.0f;
    config.limits.min_samples = static_cast<std::uint16_t>(samples);
    Bench bench(config);
    bench.noise.gyro_dps = 0.1;
    bench.Rest(70.0, 27.0);
    EXPECT_GE(bench.Count(Code::kNew), 1) << samples;
    EXPECT_LT(bench.ErrorAt(27.0), 0.1) << samples;
  }
}

}  // namespace
}  // namespace zro
