// Music as energy around each resonance, and the tone that the output data rate folds.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rig/physics/rig_model.h"
#include "rig/physics/terms/resonator.h"
#include "tests/unit/physics/sound_fixture.h"
#include "tests/unit/physics/spectrum.h"

namespace zrobench::physics {
namespace {

Inputs Music(double low_hz, double high_hz, double pa) {
  Inputs inputs;
  inputs.tone_hz = (low_hz + high_hz) / 2;
  inputs.tone_band_hz = high_hz - low_hz;
  inputs.tone_pa = pa;
  return inputs;
}

double Rms(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

/// Mean of |H|^2 over a band, by the midpoint rule: what ResonantBandGain has in closed form.
double MeanPowerGain(double low_hz, double high_hz, double resonance_hz, double q) {
  constexpr int kSteps = 200000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double hz = low_hz + (high_hz - low_hz) * (i + 0.5) / kSteps;
    sum += std::pow(ResonantGain(hz, resonance_hz, q), 2);
  }
  return sum / kSteps;
}

TEST(Music, ItsEnergyInABandIsTheIntegralOfTheResonance) {
  for (const auto& [low, high] : {std::pair{24000.0, 30000.0}, std::pair{26990.0, 27010.0},
                                  std::pair{27000.0, 29000.0}, std::pair{27030.0, 27500.0}}) {
    const double gain = ResonantBandGain((low + high) / 2, high - low, 27000, 450);
    EXPECT_NEAR(gain * gain / MeanPowerGain(low, high, 27000, 450), 1, 0.02) << low;
  }
  // A narrow band on the peak is a tone there.
  EXPECT_NEAR(ResonantBandGain(27000, 0.1, 27000, 450), 1, 1e-6);
}

TEST(Music, IsRectifiedByItsEnergyAndGrowsWithTheSquare) {
  const double share = MeanPowerGain(24000, 30000, 27000, 450);
  for (const double pa : {2.0, 6.0}) {
    RigModel rig = RigModel::Make(Silent({"acoustic.rectification"}), 200, 1).value();
    const double mean_dps = Mean(Record(rig, Music(24000, 30000, pa), 200000));
    EXPECT_NEAR(mean_dps / (0.075 * pa * pa * share), 1, 0.03) << pa;
  }
}

TEST(Music, IsNoToneEvenWhenItsCentreLiesOnTheResonance) {
  RigModel rig = RigModel::Make(Silent({"acoustic.rectification"}), 200, 1).value();
  Inputs tone = Music(24000, 30000, 6);
  tone.tone_band_hz = 0;
  const double tone_dps = rig.SampleSensors(tone).rate_dps[2];
  const double music_dps = Mean(Record(rig, Music(24000, 30000, 6), 20000));
  EXPECT_GT(music_dps, 0.005 * tone_dps);
  EXPECT_LT(music_dps, 0.03 * tone_dps);
}

TEST(Music, SwingsLikeNoiseWithTheEnergyInTheBandAndNoLine) {
  RigModel rig = RigModel::Make(Silent({"acoustic.resonance"}), 200, 1).value();
  const auto rate_dps = Record(rig, Music(24000, 30000, 6), 100000);
  const double share = MeanPowerGain(24000, 30000, 27000, 450);
  const double rms_dps = Rms(rate_dps);
  EXPECT_NEAR(rms_dps / (0.15 * 6 * std::sqrt(share / 2)), 1, 0.02);
  // A tone's sinusoid never exceeds 1.4 times its rms; noise does, often.
  int beyond = 0;
  for (const double dps : rate_dps) beyond += std::fabs(dps) > 2 * rms_dps;
  EXPECT_NEAR(beyond / 1e5, 0.0455, 0.005);  // of a Gaussian
}

TEST(Music, IsHeardAtTheResonancesOwnBeatWhereverItsBandLies) {
  RigModel fast = RigModel::Make(Silent({"acoustic.resonance"}), 4000, 1).value();
  const auto rate_dps = Record(fast, Music(25000, 31000, 6), 40000);  // middle 1 kHz above Z's
  const auto density = [&](std::size_t hz) { return Density(rate_dps, 4000, 400, hz / 10, 2); };
  // 1373 Hz from the drive, 30 Hz half wide. The band's middle would beat at 2373 and fold to 1627.
  EXPECT_GT(density(1370), 30 * density(1620));
}

TEST(Music, FadesWithinMillisecondsSoThatSamplesForgetEachOther) {
  RigModel fast = RigModel::Make(Silent({"acoustic.rectification"}), 2000, 1).value();
  const auto dps = Record(fast, Music(24000, 30000, 6), 400000);
  const double mean = Mean(dps);
  double variance = 0, lagged = 0;
  for (std::size_t i = 10; i < dps.size(); ++i) {
    variance += (dps[i] - mean) * (dps[i] - mean);
    lagged += (dps[i] - mean) * (dps[i - 10] - mean);
  }
  // The power of a complex Gaussian process correlates as its envelope's square: 5 ms on,
  // exp(-2 pi f_r t / Q).
  EXPECT_NEAR(lagged / variance, std::exp(-2 * M_PI * 27000 * 0.005 / 450), 0.02);
}

TEST(Music, EachAxisHearsItsOwnBand) {
  RigModel rig = RigModel::Make(Silent({"acoustic.rectification"}), 200, 1).value();
  const Inputs high = Music(31500, 34500, 6);  // around X
  const double x_dps = Mean(Record(rig, high, 20000, 0));
  const double z_dps = Mean(Record(rig, high, 20000, 2));
  EXPECT_GT(x_dps, 20 * z_dps);
}

TEST(Music, TheSameSeedPlaysTheSame) {
  const auto play = [](std::uint64_t seed) {
    RigModel rig = RigModel::Make(Silent({"acoustic.resonance"}), 200, seed).value();
    return Record(rig, Music(24000, 30000, 6), 500);
  };
  EXPECT_EQ(play(1), play(1));
  EXPECT_NE(play(1), play(2));
}

TEST(Music, LeavesTheOtherNoiseAsItWas) {
  Model model;
  model.terms = {"acoustic.rectification"};
  RigModel quiet = RigModel::Make(model, 200, 1).value();
  RigModel loud = RigModel::Make(model, 200, 1).value();
  Record(loud, Music(24000, 30000, 6), 500);
  Record(quiet, {}, 500);
  EXPECT_EQ(Record(loud, {}, 100), Record(quiet, {}, 100));
}

/// Frequency of the line that a tone leaves at a die temperature.
double AliasHz(double tone_hz, double die_degc) {
  Model model = Silent({"acoustic.alias"});
  model.ambient_degc = die_degc;
  RigModel rig = RigModel::Make(model, 200, 1).value();
  const auto dps = Record(rig, Tone(tone_hz, 2), 40000);
  int crossings = 0;
  for (std::size_t i = 1; i < dps.size(); ++i) crossings += (dps[i - 1] < 0) != (dps[i] < 0);
  return crossings * 200.0 / (2.0 * 40000);
}

TEST(Alias, ToneOnAMultipleOfTheDataRateStandsStillAndMovesWithTheToneHertzForHertz) {
  EXPECT_NEAR(AliasHz(27000, 25), 0, 1e-9);  // 135 times 200 Hz
  EXPECT_NEAR(AliasHz(27001, 25), 1, 0.01);
  EXPECT_NEAR(AliasHz(26987, 25), 13, 0.01);
  EXPECT_NEAR(AliasHz(27099, 25), 99, 0.01);
  EXPECT_NEAR(AliasHz(27120, 25), 80, 0.01);  // folded at 100 Hz
}

TEST(Alias, MovesWithTheGyrosClockAsItWarms) {
  EXPECT_NEAR(AliasHz(27000, 26), 2.7, 0.02);  // 100 ppm of 27 kHz
  EXPECT_NEAR(AliasHz(27000, 35), 27, 0.1);
  EXPECT_NEAR(AliasHz(27010, 26), 7.3, 0.02);  // faster when warm: its multiple comes nearer
}

TEST(Alias, StandingStillItIsAnOffsetLinearInPressure) {
  Model model = Silent({"acoustic.alias"});
  model.ambient_degc = 25;
  RigModel rig = RigModel::Make(model, 200, 1).value();
  EXPECT_NEAR(Mean(Record(rig, Tone(27000, 1), 1000)), 0.03, 1e-6);
  EXPECT_NEAR(Mean(Record(rig, Tone(27000, 2), 1000)), 0.06, 1e-6);
  EXPECT_LT(std::fabs(Mean(Record(rig, Tone(28000, 2), 1000))), 0.002);  // 1 kHz beside
}

}  // namespace
}  // namespace zrobench::physics
