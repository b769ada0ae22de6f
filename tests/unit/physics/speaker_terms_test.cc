// Effects of the speaker, and of temperature on what the gyro hears.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/physics/heat_model.h"
#include "rig/physics/rig_model.h"
#include "rig/physics/term.h"
#include "rig/physics/terms/resonator.h"
#include "tests/unit/physics/sound_fixture.h"

namespace zrobench::physics {
namespace {

/// Only the shift of axis Z, 1 dps/Pa^2 on its resonance at 27 kHz, Q 450, and one term more.
Model Rectifying(const std::string& id, TermParameters parameters) {
  Model model = Silent({id, "acoustic.rectification"});
  model.term["acoustic.rectification"]["dps_per_pa2"] = {0, 0, 1};
  model.term[id] = std::move(parameters);
  EXPECT_TRUE(FindErrors(model).empty());
  return model;
}

TEST(ResonanceDrift, AToneThatFollowsTheResonanceHearsNoTemperature) {
  HeatModel heat(Rectifying("acoustic.resonance_drift", {{"ppm_per_k", {-30}}}));
  const auto shift_dps = [&](double tone_hz, double die_degc) {
    const Inputs inputs = Tone(tone_hz, 1);
    Sensed sensed;
    ActOnSample(heat.terms(), {inputs, {0, 0, die_degc}, 0.1}, heat.states(), sensed);
    return sensed.rate_dps[2];
  };
  const double per_k_hz = -0.81;  // 27 kHz x 30 ppm
  for (const double die_degc : {-15.0, 25.0, 65.0}) {
    EXPECT_NEAR(shift_dps(27000 + per_k_hz * (die_degc - 25), die_degc), 1, 1e-9);
  }
  // A tone held 0.81 Hz/K x 40 K beside the resonance passes through it by heating: a Lorentzian.
  const double beside = ResonantGain(27000, 27000 - 32.4, 450);
  EXPECT_NEAR(shift_dps(27000, 65), beside * beside, 1e-9);
  EXPECT_LT(beside * beside, 0.6);
}

TEST(ResonanceDrift, TheBeatMovesWithTheDrive) {
  // Beats: tone - (resonance - split). 10 K warmer: the drive sinks 8.1 Hz, the beat rises by that.
  const auto beat_hz = [](double die_degc) {
    Model model;
    model.gyro = GyroModel{25, 0, 0, {}};
    model.terms = {"acoustic.resonance_drift", "acoustic.resonance"};
    model.term["acoustic.resonance"]["mode_split_hz"] = {0};
    HeatModel heat(model);
    const Inputs inputs = Tone(27010, 1);
    int crossings = 0;
    double last = 0;
    for (int i = 0; i < 20000; ++i) {
      Sensed sensed;
      ActOnSample(heat.terms(), {inputs, {0, 0, die_degc}, 0.005}, heat.states(), sensed);
      crossings += (last < 0) != (sensed.rate_dps[2] < 0);
      last = sensed.rate_dps[2];
    }
    return crossings / 200.0;
  };
  EXPECT_NEAR(beat_hz(25), 10, 0.02);
  EXPECT_NEAR(beat_hz(35), 18.1, 0.02);
}

TEST(PowerCompression, TheSoundSinksOverABurstAndRecoversInAPause) {
  RigModel rig =
      RigModel::Make(Rectifying("acoustic.power_compression", {{"per_pa2", {0.1}}, {"tau_s", {5}}}),
                     10, 1)
          .value();
  const auto play = [&](double pa, int samples) {
    std::vector<double> shift_dps;
    for (int i = 0; i < samples; ++i) {
      shift_dps.push_back(rig.SampleSensors(Tone(27000, pa)).rate_dps[2]);
    }
    return shift_dps;
  };
  const std::vector<double> burst = play(2, 300);
  for (const int tenths : {1, 50, 100, 300}) {
    const double theta = 4 * (1 - std::exp(-tenths / 50.0));
    EXPECT_NEAR(burst[static_cast<std::size_t>(tenths - 1)], std::pow(2 / (1 + 0.1 * theta), 2),
                1e-9);
  }
  play(0, 500);
  rig.PowerCycle();  // of the board: the speaker does not notice
  EXPECT_NEAR(play(2, 100)[0] / burst[0], 1, 1e-4);
  rig.PowerCycle();
  EXPECT_NEAR(play(2, 1)[0] / burst[100], 1, 1e-4);
}

TEST(Harmonics, AToneAtAThirdOfAResonanceShiftsItWithTheSixthPower) {
  const auto shift_dps = [](double tone_hz, double pa) {
    RigModel rig =
        RigModel::Make(Rectifying("acoustic.harmonics", {{"second", {0.001}}, {"third", {0.002}}}),
                       10, 1)
            .value();
    RigModel clean =
        RigModel::Make(Rectifying("acoustic.harmonics", {{"second", {0}}, {"third", {0}}}), 10, 1)
            .value();
    return rig.SampleSensors(Tone(tone_hz, pa)).rate_dps[2] -
           clean.SampleSensors(Tone(tone_hz, pa)).rate_dps[2];
  };
  EXPECT_NEAR(shift_dps(9000, 1), 0.002, 1e-6);
  EXPECT_NEAR(shift_dps(9000, 2) / shift_dps(9000, 1), 64, 0.1);
  EXPECT_NEAR(shift_dps(13500, 1), 0.001, 1e-6);
  EXPECT_NEAR(shift_dps(13500, 2) / shift_dps(13500, 1), 16, 0.1);
  EXPECT_LT(shift_dps(11000, 2), 1e-4);
}

TEST(Harmonics, BorrowsTheRectificationsStrengthAndTheResonanceBehindIt) {
  Model model = Rectifying("acoustic.harmonics", {});
  model.term["acoustic.resonance"]["q"] = {77};
  const auto flat = FlatParameters(*FindTerm("acoustic.harmonics"), model);
  ASSERT_EQ(flat.size(), 2u + 3u + 8u);
  EXPECT_EQ(flat[4], 1);
  EXPECT_EQ(flat[5 + 3], 77);
}

}  // namespace
}  // namespace zrobench::physics
