// Music, sweep and load as a profile asks for them: what is read, and what is refused before
// anything moves.
#include <gmock/gmock.h>

#include "rig/profile/plan.h"
#include "rig/profile/profile.h"
#include "tests/unit/core/toml_text.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Station Bench() {
  Station station;
  station.path = "bench.toml";
  station.model.speaker.pa_per_v = 0.5;
  return station;
}

Result<Profile> Load(const std::string& step, const Station& station = Bench()) {
  const TextFile file("schema = 1\nname = \"p\"\n[[step]]\n" + step + "\n");
  return LoadProfile(file.path(), station);
}

/// `step` is line 4.
std::vector<std::string> ErrorsOf(const std::string& step, const Station& station = Bench()) {
  const TextFile file("schema = 1\nname = \"p\"\n[[step]]\n" + step + "\n");
  const Result<Profile> profile = LoadProfile(file.path(), station);
  return profile ? std::vector<std::string>()
                 : LinesWithoutPath(profile.error().message, file.path());
}

TEST(Sounds, MusicIsABandWithTheLevelOfItsLoudPassages) {
  const Profile p =
      Load("music = { low_hz = 24000, high_hz = 34000, spl_db = 94, for_s = 30 }").value();
  const Music& music = std::get<Music>(p.steps.at(0).action);
  EXPECT_EQ(music.low_hz, 24000);
  EXPECT_EQ(music.high_hz, 34000);
  EXPECT_NEAR(music.v, 2.0, 0.01);  // 94 dB SPL is 1 Pa, at 0.5 Pa/V
  EXPECT_EQ(NominalDurationS(p, 23), 30);
}

TEST(Sounds, ASweepGoesUpOrDownAndLastsItsTonesTimesTheirDwell) {
  const Profile up =
      Load("sweep = { from_hz = 26900, to_hz = 27100, step_hz = 25, spl_db = 90, dwell_s = 2 }")
          .value();
  const Sweep& sweep = std::get<Sweep>(up.steps.at(0).action);
  EXPECT_EQ(sweep.tones(), 9);
  EXPECT_EQ(sweep.HzOf(0), 26900);
  EXPECT_EQ(sweep.HzOf(8), 27100);
  EXPECT_EQ(NominalDurationS(up, 23), 18);
  const Profile down =
      Load("sweep = { from_hz = 300, to_hz = 100, step_hz = 90, spl_db = 90, dwell_s = 0.5 }")
          .value();
  EXPECT_EQ(std::get<Sweep>(down.steps.at(0).action).HzOf(2), 120);
  EXPECT_EQ(NominalDurationS(down, 23), 1.5);
}

TEST(Sounds, LimitsOfMusicAreTheStations) {
  const auto music = [](const std::string& keys) { return ErrorsOf("music = { " + keys + " }"); };
  EXPECT_THAT(
      music("low_hz = 10, high_hz = 50000, spl_db = 121, for_s = 601"),
      ElementsAre("4:20: error: low_hz = 10 is below 20 (min_tone_hz of station bench.toml)",
                  "4:34: error: high_hz = 50000 is above 40000 (max_tone_hz of station "
                  "bench.toml)",
                  "4:50: error: spl_db = 121 is above 120 (max_spl_db of station bench.toml)",
                  "4:63: error: for_s = 601 is above 600 (max_tone_s of station bench.toml)"));
  EXPECT_THAT(music("low_hz = 300, high_hz = 200, spl_db = 90, for_s = 5"),
              ElementsAre(HasSubstr("4:35: error: high_hz = 200 is not 1 Hz or more above")));
  EXPECT_THAT(music("low_hz = 100, high_hz = 200, spl_db = 110, for_s = 5"),
              ElementsAre(HasSubstr("takes 12.6 V, above 10 (max_tone_v of station bench.toml)")));
  EXPECT_THAT(
      music("low_hz = 100, high_hz = 200, v = 1, for_s = 5"),
      ElementsAre(HasSubstr("'spl_db' is missing"), HasSubstr("'v' is not a key of music")));
}

TEST(Sounds, LimitsOfASweepAreTheStations) {
  const auto sweep = [](const std::string& keys) {
    return ErrorsOf("sweep = { " + keys + ", spl_db = 90 }");
  };
  EXPECT_THAT(sweep("from_hz = 100, to_hz = 41000, step_hz = 100, dwell_s = 1"),
              ElementsAre(HasSubstr("4:34: error: to_hz = 41000 is above 40000 (max_tone_hz")));
  EXPECT_THAT(sweep("from_hz = 100, to_hz = 1100, step_hz = 1, dwell_s = 1"),
              ElementsAre("4:63: error: 1001 tones of 1 s last 1001 s, above 600 (max_tone_s of "
                          "station bench.toml)"));
  EXPECT_THAT(sweep("from_hz = 100, to_hz = 1100, step_hz = 0.05, dwell_s = 0.2"),
              ElementsAre(HasSubstr("makes 2e+04 tones of it; 10000 are the most")));
  EXPECT_THAT(sweep("from_hz = 100, to_hz = 200, step_hz = 1e-300, dwell_s = 1e-300"),
              ElementsAre(HasSubstr("step_hz = 1e-300 is below 0.01"),
                          HasSubstr("dwell_s = 1e-300 is below 0.2 (two of the bench's ticks)")));
}

TEST(Sounds, WithoutASpeakerTheyAreRefused) {
  Station mute = Bench();
  mute.speaker.clear();
  for (const char* step :
       {"music = { low_hz = 100, high_hz = 200, spl_db = 90, for_s = 5 }",
        "sweep = { from_hz = 100, to_hz = 200, step_hz = 10, spl_db = 90, dwell_s = 1 }"}) {
    EXPECT_THAT(ErrorsOf(step, mute), ElementsAre(HasSubstr("has no speaker"))) << step;
  }
}

TEST(Load, IsADutyForATime) {
  const Profile p = Load("load = { duty_pct = 60, for_s = 90 }").value();
  EXPECT_EQ(std::get<zrobench::Load>(p.steps.at(0).action).duty_pct, 60);
  EXPECT_EQ(NominalDurationS(p, 23), 90);
  EXPECT_THAT(ErrorsOf("load = { duty_pct = 101, for_s = 1e9 }"),
              ElementsAre(HasSubstr("4:21: error: duty_pct = 101 is above 100"),
                          HasSubstr("is above 604800 (seven days)")));
  EXPECT_THAT(ErrorsOf("load = { duty_pct = 0, for_s = 5 }"),
              ElementsAre(HasSubstr("duty_pct = 0 is below 1")));
}

TEST(Stimuli, EveryKindMayComeDuringAStep) {
  const Profile p =
      Load(
          "hold = { for_s = 100 }\n"
          "with = [ { tone = { hz = 1000, spl_db = 90, for_s = 5 }, at_s = 1 },\n"
          "  { music = { low_hz = 100, high_hz = 200, spl_db = 90, for_s = 5 }, at_s = 2 },\n"
          "  { sweep = { from_hz = 100, to_hz = 200, step_hz = 10, spl_db = 90, dwell_s = 1 }, "
          "at_s = 3 },\n"
          "  { move = { how = \"tap\", for_s = 5 }, at_s = 4 },\n"
          "  { load = { duty_pct = 50, for_s = 200 }, at_s = 5 } ]")
          .value();
  const auto& with = p.steps.at(0).with;
  ASSERT_EQ(with.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<Tone>(with[0].what));
  EXPECT_EQ(std::get<Music>(with[1].what).high_hz, 200);
  EXPECT_EQ(std::get<Sweep>(with[2].what).for_s, 11);
  EXPECT_TRUE(std::holds_alternative<Move>(with[3].what));
  EXPECT_EQ(std::get<zrobench::Load>(with[4].what).duty_pct, 50);
  EXPECT_EQ(NominalDurationS(p, 23), 205);  // a step ends when its stimuli have
}

TEST(Stimuli, AStimulusIsOneThingAndNoStepOfItsOwnKind) {
  const std::string tap = "move = { how = \"tap\", for_s = 1 }";
  const auto with = [](const std::string& stimulus) {
    return ErrorsOf("hold = { for_s = 9 }\nwith = [ { " + stimulus + ", at_s = 1 } ]");
  };
  EXPECT_THAT(
      with(tap + ", load = { duty_pct = 50, for_s = 1 }"),
      ElementsAre(HasSubstr("5:10: error: a stimulus holds one tone, music, sweep, move or")));
  EXPECT_THAT(with("soak = { to_degc = 20, hold_s = 1 }"),
              testing::Contains(HasSubstr("'soak' is not a key of with")));
}

TEST(Bounds, AbsurdlySmallNumbersAreSaidToBe) {
  EXPECT_THAT(ErrorsOf("ramp = { to_degc = 30, rate_degc_per_min = 1e-300 }"),
              ElementsAre("4:44: error: rate_degc_per_min = 1e-300 is below 0.01 (slower than any "
                          "bench)"));
  EXPECT_THAT(ErrorsOf("soak = { to_degc = 30, hold_s = 1e-300, settled_degc = 1e-300 }"),
              ElementsAre(HasSubstr("hold_s = 1e-300 is below 0.1 (the bench's tick)"),
                          HasSubstr("settled_degc = 1e-300 is below 0.01")));
  EXPECT_THAT(ErrorsOf("tone = { hz = 1000, v = 1e-300, for_s = 1e-300 }"),
              ElementsAre(HasSubstr("v = 1e-300 is below 1e-06 (a microvolt)"),
                          HasSubstr("for_s = 1e-300 is below 0.1")));
  EXPECT_THAT(ErrorsOf("power_cycle = { off_s = 1e-300 }"),
              ElementsAre(HasSubstr("off_s = 1e-300 is below 0.1")));
  EXPECT_THAT(
      ErrorsOf("hold = { for_s = 1 }\n[[expect]]\nresidual_rate = { within_mdps = 1e-300 }"),
      ElementsAre(HasSubstr("6:33: error: within_mdps = 1e-300 is below 0.001")));
}

TEST(Bounds, AProfileEndsWithinAWeekAndTheStepThatGoesBeyondIsNamed) {
  const std::string three_days = "hold = { for_s = 259200 }\n[[step]]\n";
  EXPECT_THAT(ErrorsOf(three_days + three_days + three_days + "hold = { for_s = 1 }"),
              ElementsAre("7:1: error: with this step the profile takes 9.0 days or more; seven "
                          "are the most"));
  EXPECT_THAT(ErrorsOf(three_days + three_days + "hold = { for_s = 1 }"), ElementsAre());
  // 0.01 degC/min over 80 degC are 5.6 days: one such ramp will do.
  const std::string down = "ramp = { to_degc = -15, rate_degc_per_min = 0.01 }\n";
  Station dry = Bench();
  dry.purge = true;
  EXPECT_THAT(ErrorsOf("soak = { to_degc = 65, hold_s = 1 }\n[[step]]\n" + down, dry),
              ElementsAre());
  EXPECT_THAT(ErrorsOf("ramp = { to_degc = 65, rate_degc_per_min = 0.01 }\n[[step]]\n" + down, dry),
              ElementsAre(HasSubstr("5:1: error: with this step the profile takes 8.5 days")));
}

}  // namespace
}  // namespace zrobench
