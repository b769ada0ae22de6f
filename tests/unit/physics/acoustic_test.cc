#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/units.h"
#include "rig/physics/rig_model.h"
#include "rig/physics/terms/resonator.h"
#include "tests/unit/physics/sound_fixture.h"

namespace zrobench::physics {
namespace {

/// Amplitude of the sinusoid in x.
double Amplitude(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return std::sqrt(2 * sum / static_cast<double>(x.size()));
}

double FrequencyByCounting(const std::vector<double>& x, double sample_hz) {
  int crossings = 0;
  for (std::size_t i = 1; i < x.size(); ++i) crossings += (x[i - 1] < 0) != (x[i] < 0);
  return crossings * sample_hz / (2 * static_cast<double>(x.size()));
}

double Folded(double hz, double sample_hz) {
  return std::fabs(hz - sample_hz * std::round(hz / sample_hz));
}

TEST(Resonance, HalfPowerWidthIsFrequencyOverQ) {
  const double f_r = 27000, q = 450;
  EXPECT_DOUBLE_EQ(ResonantGain(f_r, f_r, q), 1);
  // Bisection for |H|^2 = 1/2 on either side.
  const auto edge = [&](double outside) {
    double inside = f_r;
    for (int i = 0; i < 60; ++i) {
      const double middle = (inside + outside) / 2;
      (std::pow(ResonantGain(middle, f_r, q), 2) > 0.5 ? inside : outside) = middle;
    }
    return inside;
  };
  const double width_hz = edge(28000) - edge(26000);
  EXPECT_NEAR(width_hz / (f_r / q), 1, 1e-4);
}

TEST(Resonance, FarBelowItIsStiffAndFarAboveItIsMass) {
  EXPECT_NEAR(ResonantGain(27, 27000, 450), 1 / 450.0, 1e-6);
  EXPECT_NEAR(ResonantGain(270000, 27000, 450) * 450, 0.01, 2e-4);
}

TEST(Resonance, InjectionIsASinusoidProportionalToPressure) {
  RigModel rig = RigModel::Make(Silent({"acoustic.resonance"}), 200, 1).value();
  const std::vector<double> soft = Record(rig, Tone(27000, 1), 20000);
  const std::vector<double> loud = Record(rig, Tone(27000, 2), 20000);
  EXPECT_NEAR(Amplitude(soft), 0.15, 1e-4);
  EXPECT_NEAR(Amplitude(loud) / Amplitude(soft), 2, 1e-3);
  EXPECT_NEAR(Mean(loud), 0, 1e-4);
}

TEST(Resonance, BeatFoldsAtTheSampleRate) {
  for (const double sample_hz : {50.0, 200.0, 1000.0}) {
    for (const double tone_hz : {26980.0, 27000.0, 27013.5, 27100.0}) {
      RigModel rig = RigModel::Make(Silent({"acoustic.resonance"}), sample_hz, 1).value();
      const auto rate_dps = Record(rig, Tone(tone_hz, 2), 40000);
      const double beat_hz = tone_hz - (27000 - 1373);
      EXPECT_NEAR(FrequencyByCounting(rate_dps, sample_hz), Folded(beat_hz, sample_hz),
                  sample_hz / 20000)
          << tone_hz << " Hz sampled at " << sample_hz << " Hz";
    }
  }
}

TEST(Resonance, WithoutModeSplitTheBeatIsTheDistanceToResonance) {
  Model model = Silent({"acoustic.resonance"});
  model.term["acoustic.resonance"]["mode_split_hz"] = {0};
  RigModel rig = RigModel::Make(model, 200, 1).value();
  const auto near = Record(rig, Tone(27012, 2), 20000);
  EXPECT_NEAR(FrequencyByCounting(near, 200), 12, 0.01);
  RigModel on_top = RigModel::Make(model, 200, 1).value();
  for (const double rate_dps : Record(on_top, Tone(27000, 2), 100))
    EXPECT_NEAR(rate_dps, 0.3, 1e-9);
}

TEST(Resonance, ShiftingTheToneByOneHertzShiftsTheAliasByOneHertz) {
  const auto alias_hz = [](double tone_hz) {
    RigModel rig = RigModel::Make(Silent({"acoustic.resonance"}), 200, 1).value();
    return FrequencyByCounting(Record(rig, Tone(tone_hz, 2), 40000), 200);
  };
  EXPECT_NEAR(std::fabs(alias_hz(27001) - alias_hz(27000)), 1, 0.02);
}

TEST(Resonance, PhaseIsContinuousWhenTheToneMoves) {
  // Beats of 5 and 6 Hz at 200 samples/s: a step between samples never exceeds the sinusoid's own.
  Model model = Silent({"acoustic.resonance"});
  model.term["acoustic.resonance"]["mode_split_hz"] = {0};
  RigModel rig = RigModel::Make(model, 200, 1).value();
  double last_dps = rig.SampleSensors(Tone(27005, 2)).rate_dps[2];
  for (int i = 0; i < 2000; ++i) {
    const double now_dps = rig.SampleSensors(Tone(i % 70 < 35 ? 27005 : 27006, 2)).rate_dps[2];
    EXPECT_LT(std::fabs(now_dps - last_dps), 0.3 * 2 * std::numbers::pi * 6 / 200 + 0.005);
    last_dps = now_dps;
  }
}

TEST(Resonance, PowerCycleRestartsTheBeat) {
  RigModel rig = RigModel::Make(Silent({"acoustic.resonance"}), 200, 1).value();
  const auto first = Record(rig, Tone(27000, 2), 137);
  rig.PowerCycle();
  EXPECT_EQ(Record(rig, Tone(27000, 2), 137), first);
}

TEST(Rectification, GrowsWithTheSquareOfPressure) {
  RigModel rig = RigModel::Make(Silent({"acoustic.rectification"}), 200, 1).value();
  const double soft_dps = rig.SampleSensors(Tone(27010, 0.7)).rate_dps[2];
  const double loud_dps = rig.SampleSensors(Tone(27010, 1.4)).rate_dps[2];
  EXPECT_GT(soft_dps, 0.01);
  EXPECT_NEAR(loud_dps / soft_dps, 4, 1e-12);
}

TEST(Rectification, FollowsTheResonancesParametersAndSquare) {
  Model model = Silent({"acoustic.rectification"});
  model.term["acoustic.resonance"]["resonance_hz"] = {20000, 21000, 22000};
  model.term["acoustic.resonance"]["q"] = {100};
  model.term["acoustic.rectification"]["dps_per_pa2"] = {1, -2, 3};
  RigModel rig = RigModel::Make(model, 200, 1).value();
  const double pa = 0.5;
  const Axes rate_dps = rig.SampleSensors(Tone(20900, pa)).rate_dps;
  const Axes resonance_hz = {20000, 21000, 22000}, strength = {1, -2, 3};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gain = ResonantGain(20900, resonance_hz[axis], 100);
    EXPECT_NEAR(rate_dps[axis], strength[axis] * pa * pa * gain * gain, 1e-15);
  }
  EXPECT_GT(std::fabs(rate_dps[1]), 10 * std::fabs(rate_dps[2]));
}

TEST(Acoustics, DefaultsGiveATenthsOfADpsAtResonanceAndNothingBesideIt) {
  const double pa = PaFromSplDb(100);
  RigModel rig =
      RigModel::Make(Silent({"acoustic.resonance", "acoustic.rectification"}), 200, 1).value();
  const auto at_resonance = Record(rig, Tone(27000, pa), 20000);
  EXPECT_NEAR(Mean(at_resonance), 0.3, 0.005);
  auto swing = at_resonance;
  for (double& value : swing) value -= Mean(at_resonance);
  EXPECT_NEAR(Amplitude(swing), 0.3, 0.005);
  // 1 kHz away: below a fifth of the default white noise of 50 mdps a sample, and 0.3 mdps of DC.
  const auto beside = Record(rig, Tone(28000, pa), 20000);
  EXPECT_LT(std::fabs(Mean(beside)), 0.0005);
  EXPECT_LT(Amplitude(beside), 0.01);
  // The other axes are deaf to Z's resonance.
  EXPECT_LT(Amplitude(Record(rig, Tone(27000, pa), 20000, 0)), 0.005);
}

TEST(Acoustics, SilenceLeavesNoTrace) {
  RigModel rig =
      RigModel::Make(Silent({"acoustic.resonance", "acoustic.rectification"}), 200, 1).value();
  for (const double rate_dps : Record(rig, Tone(27000, 0), 100)) EXPECT_EQ(rate_dps, 0);
}

}  // namespace
}  // namespace zrobench::physics
