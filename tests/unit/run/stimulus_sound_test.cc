#include "rig/run/stimulus_sound.h"

#include <gtest/gtest.h>

#include <set>

#include "core/units.h"

namespace zrobench {
namespace {

Stimulus Of(decltype(Stimulus::what) what) { return {std::move(what), 0.0, {}}; }

const Music kMusic{.low_hz = 24000, .high_hz = 34000, .v = 4, .spl_db = 106, .for_s = 60};
const Sweep kSweep{.from_hz = 27100,
                   .to_hz = 26900,
                   .step_hz = 50,
                   .v = 2,
                   .spl_db = 100,
                   .dwell_s = 0.3,
                   .for_s = 1.5};

TEST(Sound, MusicFillsItsBandNeverLouderThanSaidAndChangesItsLoudnessByTenfold) {
  std::set<double> levels;
  for (double t = 0; t < 60; t += 0.1) {
    const Sound sound = SoundAt(Of(kMusic), t);
    EXPECT_EQ(sound.hz, 29000);
    EXPECT_EQ(sound.band_hz, 10000);
    EXPECT_LE(sound.v, 4);
    EXPECT_NEAR(sound.v / 4, PaFromSplDb(sound.spl_db) / PaFromSplDb(106), 1e-12);
    levels.insert(sound.v);
  }
  EXPECT_EQ(*levels.rbegin(), 4);
  EXPECT_NEAR(*levels.begin(), 0.4, 1e-12);
  EXPECT_GE(levels.size(), 6u);
}

TEST(Sound, MusicHoldsEachPassageForTwoSeconds) {
  int changes = 0;
  for (int tick = 1; tick < 160; ++tick) {
    changes += !(SoundAt(Of(kMusic), tick * 0.1) == SoundAt(Of(kMusic), (tick - 1) * 0.1));
  }
  EXPECT_EQ(changes, 7);
}

TEST(Sound, ASweepVisitsEveryToneForItsDwellAndStaysOnTheLast) {
  EXPECT_EQ(SoundAt(Of(kSweep), 0).hz, 27100);
  EXPECT_EQ(SoundAt(Of(kSweep), 0.2999).hz, 27100);
  EXPECT_EQ(SoundAt(Of(kSweep), 0.3).hz, 27050);
  EXPECT_EQ(SoundAt(Of(kSweep), 0.3 * 3).hz, 26950);  // 0.9 as a double lies below three dwells
  EXPECT_EQ(SoundAt(Of(kSweep), 1.4).hz, 26900);
  EXPECT_EQ(SoundAt(Of(kSweep), 9).hz, 26900);
  EXPECT_EQ(SoundAt(Of(kSweep), 0).band_hz, 0);
}

TEST(Sound, HandsAndLoadsAreSilent) {
  EXPECT_FALSE(Sounds(Of(Move{"tap", 3})));
  EXPECT_FALSE(Sounds(Of(Load{50, 3})));
  EXPECT_TRUE(Sounds(Of(kMusic)));
  EXPECT_TRUE(Sounds(Of(Tone{1000, 1, 94, 3})));
}

}  // namespace
}  // namespace zrobench
