#include "rig/run/stimulus_player.h"

#include <gmock/gmock.h>

#include "tests/unit/run/fake_bench.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Tone kTone{1000, 1, 94, 5};
const Move kMove{"tap", 4};

class StimulusPlayerTest : public BenchTest {
 protected:
  StimulusPlayer player_{bench_, *log_};
  std::vector<std::string> Begun() { return Events(EventItem::Kind::kStimulusBegin); }
  void SetUp() override {}
  StimulusPlayerTest() { BenchTest::SetUp(); }
};

TEST_F(StimulusPlayerTest, StartsAtItsTimeAndEndsAfterItsLength) {
  player_.Schedule({{kTone, 2.0, {}}});
  ASSERT_TRUE(player_.Update({}));
  EXPECT_FALSE(player_.playing());
  EXPECT_EQ(player_.waiting(), 1);
  Pass(2);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_TRUE(player_.playing());
  EXPECT_EQ(speaker_.hz, 1000);
  Pass(4.9);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_TRUE(player_.playing());
  Pass(0.1);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_FALSE(player_.playing());
  EXPECT_EQ(speaker_.v, 0);
  EXPECT_EQ(player_.waiting(), 0);
}

TEST_F(StimulusPlayerTest, StartsWhenTheTemperaturePassesInEitherDirectionOnce) {
  for (const auto& path : {std::vector{27.0, 27.9, 28.1}, std::vector{29.0, 28.1, 27.9}}) {
    player_.Schedule({{kTone, {}, 28.0}});
    for (const double degc : path) {
      EXPECT_FALSE(player_.playing()) << degc;
      ASSERT_TRUE(player_.Update(degc));
    }
    EXPECT_TRUE(player_.playing());
    Pass(5);
    ASSERT_TRUE(player_.Update(path.front()));
    EXPECT_FALSE(player_.playing());
  }
  EXPECT_EQ(Begun().size(), 2u);
}

TEST_F(StimulusPlayerTest, AToneAndAMoveOverlapTwoTonesFollowEachOther) {
  Tone second = kTone;
  second.hz = 2000;
  player_.Schedule({{kTone, 0.0, {}}, {second, 1.0, {}}, {kMove, 1.0, {}}});
  ASSERT_TRUE(player_.Update({}));
  Pass(1);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_EQ(speaker_.hz, 1000);
  EXPECT_THAT(hand_.moves, ElementsAre("tap"));
  Pass(4);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_EQ(speaker_.hz, 2000);
  EXPECT_THAT(Begun(), ElementsAre("tone", "move tap", "tone"));
}

TEST_F(StimulusPlayerTest, AMoveThatNobodyMakesIsSkippedAndSaidSo) {
  hand_.there = false;
  player_.Schedule({{kMove, 0.0, {}}});
  ASSERT_TRUE(player_.Update({}));
  bench_.hand = nullptr;
  player_.Schedule({{kMove, 0.0, {}}});
  ASSERT_TRUE(player_.Update({}));
  EXPECT_FALSE(player_.playing());
  EXPECT_THAT(Begun(), ElementsAre());
  EXPECT_THAT(Events(EventItem::Kind::kAlarm),
              ElementsAre(HasSubstr("unattended"), HasSubstr("skipped")));
}

TEST_F(StimulusPlayerTest, AbortEndsWhatPlaysOnRecord) {
  player_.Schedule({{kTone, 0.0, {}}, {kMove, 0.0, {}}});
  ASSERT_TRUE(player_.Update({}));
  ASSERT_TRUE(player_.Abort());
  EXPECT_FALSE(player_.playing());
  EXPECT_EQ(speaker_.v, 0);
  EXPECT_THAT(Events(EventItem::Kind::kStimulusEnd), ElementsAre("tone", "move tap"));
}

const Music kMusic{.low_hz = 24000, .high_hz = 34000, .v = 4, .spl_db = 106, .for_s = 16};
const Sweep kSweep{.from_hz = 26900,
                   .to_hz = 27100,
                   .step_hz = 50,
                   .v = 2,
                   .spl_db = 100,
                   .dwell_s = 0.5,
                   .for_s = 2.5};

TEST_F(StimulusPlayerTest, MusicChangesItsLoudnessAndEveryChangeIsOnRecord) {
  player_.Add({kMusic, {}, {}});
  for (int tick = 0; tick < 160; ++tick) {
    ASSERT_TRUE(player_.Update({}));
    EXPECT_TRUE(player_.playing());
    EXPECT_EQ(speaker_.band_hz, 10000);
    Pass(0.1);
  }
  ASSERT_TRUE(player_.Update({}));
  EXPECT_FALSE(player_.playing());
  EXPECT_EQ(speaker_.v, 0);
  EXPECT_EQ(speaker_.played_v.size(), 8u);
  const auto items = Recorded<SpeakerItem>();
  ASSERT_EQ(items.size(), 9u);
  EXPECT_EQ(items[0].band_hz, 10000);
  EXPECT_EQ(items[0].hz, 29000);
  EXPECT_EQ(items[0].spl_db, 106);
  EXPECT_EQ(items[1].spl_db, 100);
  EXPECT_EQ(items[8].v, 0);
  EXPECT_THAT(Begun(), ElementsAre("music 24000-34000 Hz"));
}

TEST_F(StimulusPlayerTest, ASweepStepsThroughItsTones) {
  player_.Add({kSweep, {}, {}});
  for (int tick = 0; tick < 26; ++tick) {
    ASSERT_TRUE(player_.Update({}));
    Pass(0.1);
  }
  ASSERT_TRUE(player_.Update({}));
  EXPECT_FALSE(player_.playing());
  EXPECT_THAT(speaker_.played_hz, ElementsAre(26900, 26950, 27000, 27050, 27100));
  EXPECT_THAT(Begun(), ElementsAre("sweep 26900-27100 Hz"));
}

TEST_F(StimulusPlayerTest, ThereIsOneSpeakerForAllThatSounds) {
  player_.Schedule({{kTone, 0.0, {}}, {kSweep, 0.0, {}}, {kMusic, 0.0, {}}});
  ASSERT_TRUE(player_.Update({}));
  EXPECT_EQ(player_.waiting(), 2);
  Pass(5);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_EQ(speaker_.hz, 26900);
  EXPECT_EQ(player_.waiting(), 1);
}

TEST_F(StimulusPlayerTest, AGeneratorOfSinesSkipsMusicAndSaysSo) {
  speaker_.sines_only = true;
  player_.Add({kMusic, {}, {}});
  ASSERT_TRUE(player_.Update({}));
  EXPECT_FALSE(player_.playing());
  EXPECT_THAT(Begun(), ElementsAre());
  EXPECT_THAT(Events(EventItem::Kind::kAlarm),
              ElementsAre("music 24000-34000 Hz skipped: this generator knows sines only"));
}

TEST_F(StimulusPlayerTest, ALoadIsOnTheBoardForItsTimeIsNoProvocationAndIsOnRecord) {
  player_.Schedule({{Load{60, 5}, 1.0, {}}});
  ASSERT_TRUE(player_.Update({}));
  EXPECT_EQ(board_.load_pct, 0);
  Pass(1);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_EQ(board_.load_pct, 60);
  EXPECT_TRUE(player_.playing());
  EXPECT_FALSE(player_.provoking());
  EXPECT_EQ(log_->snapshot().load_pct, 60);
  Pass(5);
  ASSERT_TRUE(player_.Update({}));
  EXPECT_EQ(board_.load_pct, 0);
  EXPECT_EQ(log_->snapshot().load_pct, 0);
  EXPECT_THAT(Events(EventItem::Kind::kLoad), ElementsAre("load", "load"));
  EXPECT_THAT(Begun(), ElementsAre());
}

}  // namespace
}  // namespace zrobench
