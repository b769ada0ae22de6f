// What a wrong profile says: every fault, with its place, and whose limit it breaks.
#include <gmock/gmock.h>

#include "rig/profile/profile.h"
#include "tests/unit/core/toml_text.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Station Bench() {
  Station station;
  station.path = "bench.toml";
  station.limits.min_degc = 5;
  station.limits.max_degc = 45;
  station.limits.max_rate_degc_per_min = 5;
  station.model.speaker.pa_per_v = 0.5;
  return station;
}

std::vector<std::string> ErrorsOf(const std::string& steps, const Station& station = Bench()) {
  const TextFile file("schema = 1\nname = \"p\"\n" + steps);  // `steps` begin on line 3
  const Result<Profile> profile = LoadProfile(file.path(), station);
  if (profile) return {};
  EXPECT_EQ(profile.error().kind, Error::Kind::kConfig);
  return LinesWithoutPath(profile.error().message, file.path());
}

const std::string kHold = "[[step]]\nhold = { for_s = 10 }\n";

TEST(ProfileErrors, AllAtOnceInFileOrder) {
  EXPECT_THAT(
      ErrorsOf("[[step]]\n"
               "ramp = { to_degc = 50, rate_degc_per_s = 0.1 }\n"
               "[[step]]\n"
               "soak = { to_degc = 20, hold_s = inf }\n"
               "[[step]]\n"
               "hold = { for_s = 604801 }\n"
               "colour = 1\n"
               "[[step]]\n"
               "move = { how = \"rotat\", for_s = 0 }\n"
               "[[expect]]\n"
               "table_acuracy = { within_mdps = 3 }\n"),
      ElementsAre(
          "4:8: error: 'rate_degc_per_min' is missing in ramp",
          "4:20: error: to_degc = 50 is above 45 (max_degc of station bench.toml)",
          "4:24: error: 'rate_degc_per_s' is not a key of ramp; wrong unit, write it in "
          "degc_per_min as 'rate_degc_per_min'",
          "6:33: error: hold_s must be a finite number",
          "8:18: error: for_s = 604801 is above 604800 (seven days)",
          HasSubstr("9:1: error: 'colour' is not a key of step"),
          "11:16: error: how = \"rotat\" is not one of tap, rotate, vibrate, hand_held; did "
          "you mean 'rotate'?",
          "11:33: error: for_s = 0 is below 0.1 (the bench's tick)",
          "13:1: error: 'table_acuracy' is not a key of expect; did you mean "
          "'table_accuracy'?"));
}

TEST(ProfileErrors, ToneLimitsAreTheStations) {
  const auto tone = [](const std::string& keys) {
    return ErrorsOf("[[step]]\ntone = { " + keys + " }\n");
  };
  EXPECT_THAT(tone("hz = 50000, v = 1, for_s = 1"),
              ElementsAre("4:15: error: hz = 50000 is above 40000 (max_tone_hz of station "
                          "bench.toml)"));
  EXPECT_THAT(tone("hz = 1, v = 1, for_s = 1"), ElementsAre(HasSubstr("is below 20 (min_tone_hz")));
  EXPECT_THAT(tone("hz = 1000, v = 11, for_s = 1"),
              ElementsAre(HasSubstr("is above 10 (max_tone_v")));
  EXPECT_THAT(tone("hz = 1000, spl_db = 121, for_s = 1"),
              ElementsAre(HasSubstr("is above 120 (max_spl_db")));
  // 110 dB is 6.32 Pa, which this speaker makes of 12.6 V.
  EXPECT_THAT(tone("hz = 1000, spl_db = 110, for_s = 1"),
              ElementsAre("4:30: error: spl_db = 110 takes 12.6 V, above 10 (max_tone_v of station "
                          "bench.toml)"));
  EXPECT_THAT(tone("hz = 1000, v = 1, spl_db = 90, for_s = 1"),
              ElementsAre(HasSubstr("either spl_db or v")));
  EXPECT_THAT(tone("hz = 1000, for_s = 1"), ElementsAre(HasSubstr("either spl_db or v")));
  EXPECT_THAT(tone("hz = 1000, v = 1, for_s = 601"), ElementsAre(HasSubstr("max_tone_s")));
  Station loud = Bench();
  loud.limits.max_spl_db = 80;
  EXPECT_THAT(ErrorsOf("[[step]]\ntone = { hz = 1000, v = 1, for_s = 1 }\n", loud),
              ElementsAre(HasSubstr("v = 1 makes 88.0 dB SPL, above 80")));
}

TEST(ProfileErrors, RatesAndSetPointsAreTheStations) {
  EXPECT_THAT(ErrorsOf("[[step]]\nramp = { to_degc = 40, rate_degc_per_min = 6.0 }\n"),
              ElementsAre("4:44: error: rate_degc_per_min = 6 is above 5 (max_rate_degc_per_min of "
                          "station bench.toml)"));
  EXPECT_THAT(ErrorsOf("[[step]]\nsoak = { to_degc = 4.9, hold_s = 1 }\n"),
              ElementsAre(HasSubstr("4:20: error: to_degc = 4.9 is below 5 (min_degc of station")));
}

TEST(ProfileErrors, KindsOfLaterVersionsAreRefused) {
  for (const char* kind : {"confirm"}) {
    EXPECT_THAT(ErrorsOf(std::string("[[step]]\n") + kind + " = { anything = 1 }\n"),
                ElementsAre(HasSubstr("not supported by this version")))
        << kind;
  }
}

TEST(ProfileErrors, AStepDoesOneThing) {
  EXPECT_THAT(ErrorsOf("[[step]]\nhold = { for_s = 1 }\nmove = { how = \"tap\", for_s = 1 }\n"),
              ElementsAre(HasSubstr("5:8: error: a step does one thing")));
  EXPECT_THAT(ErrorsOf("[[step]]\n"), ElementsAre("3:1: error: this [[step]] does nothing"));
  EXPECT_THAT(ErrorsOf("step = 3\n"), ElementsAre(HasSubstr("3:8: error: step must be an array")));
  EXPECT_THAT(ErrorsOf(""), ElementsAre(HasSubstr("'step' is missing")));
}

TEST(ProfileErrors, AStimulusMustBeAbleToStart) {
  const auto ramp = [](const std::string& stimulus) {
    return ErrorsOf(
        "[[step]]\nsoak = { to_degc = 20, hold_s = 1 }\n"
        "[[step]]\nramp = { to_degc = 40, rate_degc_per_min = 5 }\nwith = [ { " +
        stimulus + " } ]\n");
  };
  const std::string tap = "move = { how = \"tap\", for_s = 1 }";
  EXPECT_THAT(ramp(tap + ", at_degc = 41"),
              ElementsAre("7:57: error: at_degc = 41 is not passed on the way from 20 to 40"));
  EXPECT_THAT(ramp(tap), ElementsAre(HasSubstr("either at_s or at_degc")));
  EXPECT_THAT(ramp(tap + ", at_s = 1, at_degc = 30"), ElementsAre(HasSubstr("either at_s or")));
  EXPECT_THAT(ramp("at_s = 1"), ElementsAre(HasSubstr("one tone, music, sweep, move or load")));
  EXPECT_THAT(ErrorsOf("[[step]]\nhold = { for_s = 5 }\nwith = [ { " + tap + ", at_s = 5 } ]\n"),
              ElementsAre(HasSubstr("after the hold's end")));
  EXPECT_THAT(
      ErrorsOf("[[step]]\nhold = { for_s = 5 }\nwith = [ { " + tap + ", at_degc = 25 } ]\n"),
      ElementsAre(HasSubstr("only a soak or a ramp passes a temperature")));
}

TEST(ProfileErrors, AHalfReadStepBreedsNoFollowOnErrors) {
  EXPECT_THAT(ErrorsOf("[[step]]\nsoak = { to_degc = 20, hold_s = 1 }\n"
                       "[[step]]\nramp = { to_degc = \"40\", rate_degc_per_min = 5 }\n"
                       "with = [ { move = { how = \"tap\", for_s = 1 }, at_degc = 30 } ]\n"
                       "[[step]]\nramp = { to_degc = 35, rate_degc_per_min = 5 }\n"
                       "with = [ { move = { how = \"tap\", for_s = 1 }, at_degc = 38 } ]\n"),
              ElementsAre("6:20: error: to_degc must be a number, not a text"));
}

TEST(ProfileErrors, NeedsBindStationAndSteps) {
  Station bare = Bench();
  bare.speaker.clear();
  bare.power.clear();
  EXPECT_THAT(ErrorsOf("needs = { speaker = true, power = true }\n" + kHold, bare),
              ElementsAre(HasSubstr("has no speaker"), HasSubstr("cannot switch")));
  EXPECT_THAT(ErrorsOf("[[step]]\ntone = { hz = 1000, v = 1, for_s = 1 }\n", bare),
              ElementsAre(HasSubstr("has no speaker")));
  EXPECT_THAT(ErrorsOf("needs = { min_degc = 20, max_degc = 30 }\n"
                       "[[step]]\nsoak = { to_degc = 31, hold_s = 1 }\n"
                       "[[step]]\nsoak = { to_degc = 19, hold_s = 1 }\n"),
              ElementsAre(HasSubstr("4:1: error: 31 degC is above max_degc = 30 of [needs]"),
                          HasSubstr("6:1: error: 19 degC is below min_degc = 20 of [needs]")));
}

TEST(ProfileErrors, ExpectationsAreCheckedAgainstTheCatalogue) {
  const auto expect = [](const std::string& table) {
    return ErrorsOf(kHold + "[[expect]]\n" + table + "\n");
  };
  EXPECT_THAT(expect("table_accuracy = { from_degc = 30, to_degc = 20, within_mdps = 1 }"),
              ElementsAre("6:32: error: from_degc = 30 is not below to_degc = 20"));
  EXPECT_THAT(
      expect("table_accuracy = { from_degc = 10 }"),
      ElementsAre(HasSubstr("'to_degc' is missing"), HasSubstr("'within_mdps' is missing")));
  EXPECT_THAT(expect("rejects = { code = 17 }"), ElementsAre(HasSubstr("code = 17 is above 16")));
  EXPECT_THAT(expect("rejects = { codes = [1, 2.5] }"), ElementsAre(HasSubstr("whole numbers")));
  EXPECT_THAT(expect("rejects = { code = 1, codes = [1] }"),
              ElementsAre(HasSubstr("either code or codes")));
  EXPECT_THAT(expect("rejects = { during = \"opera\" }"),
              ElementsAre(HasSubstr("tone, music, sweep, move, tap")));
  EXPECT_THAT(expect("rejects = { at_least = 0.5 }"), ElementsAre(HasSubstr("at_least = 0.5")));
  EXPECT_THAT(expect("residual_rate = { within_dps = 1 }"),
              ElementsAre(HasSubstr("'within_mdps' is missing"), HasSubstr("'within_mdps'")));
  EXPECT_THAT(expect("lockstep = { strict = true }"), ElementsAre(HasSubstr("it takes no keys")));
  EXPECT_THAT(expect("lockstep = true"), ElementsAre(HasSubstr("lockstep must be a table")));
  EXPECT_THAT(expect("lockstep = {}\ntable_persists = {}"),
              ElementsAre(HasSubstr("wants its own [[expect]]")));
  EXPECT_THAT(expect(""), ElementsAre(HasSubstr("5:1: error: this [[expect]] names no check")));
}

TEST(ProfileErrors, AnotherSchemaIsRefused) {
  const TextFile file("schema = 2\nname = \"p\"\n" + kHold);
  const Result<Profile> profile = LoadProfile(file.path(), Bench());
  ASSERT_FALSE(profile);
  EXPECT_THAT(profile.error().message, HasSubstr(":1:10: error: schema = 2 is above 1"));
}

TEST(ProfileErrors, BrokenTomlAndMissingFiles) {
  EXPECT_THAT(ErrorsOf("[[step]\n"), ElementsAre(HasSubstr("3:")));
  const Result<Profile> missing = LoadProfile("no/such.toml", Bench());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, Error::Kind::kFile);
}

TEST(ProfileErrors, LimitsOfChecks) {
  EXPECT_THAT(
      ErrorsOf(kHold + "[[expect]]\n"
                       "table_coverage = { from_degc = 0, to_degc = 9, step_degc = 0.01, "
                       "min_pct = 50 }\n"
                       "[[expect]]\nentry_age = { at_most_days = 1.5 }\n"
                       "[[expect]]\nno_unexpected_rejection = {}\n"
                       "[[expect]]\nresidual_rate = { within_mdps = 9, piece_s = 1 }\n"
                       "[[expect]]\ngranularity = { from_degc = 9, to_degc = 0, within_degc = 3 }\n"
                       "[[expect]]\nextrapolation_held = { beyond_degc = -1, within_mdps = 3 }\n"),
      ElementsAre("6:60: error: step_degc = 0.01 is below 0.1",
                  "8:30: error: at_most_days must be a whole number",
                  "10:27: error: 'at_most' is missing in no_unexpected_rejection",
                  "12:46: error: piece_s = 1 is below 2",
                  "14:29: error: from_degc = 9 is not below to_degc = 0",
                  "16:38: error: beyond_degc = -1 is below 0"));
}

TEST(ProfileErrors, TheDateMovesByWholeDaysAndOnAVirtualBenchOnly) {
  EXPECT_THAT(ErrorsOf("[[step]]\ndate = { advance_days = 1.5 }\n"),
              ElementsAre(HasSubstr("error: advance_days must be a whole number")));
  EXPECT_THAT(ErrorsOf("[[step]]\ndate = { advance_days = 0 }\n"),
              ElementsAre(HasSubstr("advance_days = 0 is below 1")));
  EXPECT_THAT(ErrorsOf("[[step]]\ndate = {}\n"),
              ElementsAre(HasSubstr("'advance_days' is missing in date")));
  EXPECT_THAT(ErrorsOf("[[step]]\ndate = { advance_days = 40 }\n"), ElementsAre());
  Station real = Bench();
  real.board = "can:can0";
  EXPECT_THAT(ErrorsOf("[[step]]\ndate = { advance_days = 40 }\n", real),
              ElementsAre(HasSubstr("only a virtual rig can move the date")));
}

TEST(ProfileErrors, DecisionsAreCountedByCodeAndLimit) {
  EXPECT_THAT(ErrorsOf(kHold + "[[expect]]\ndecides = { code = 34 }\n"
                               "[[expect]]\ndecides = { at_least = 1, at_most = 2 }\n"
                               "[[expect]]\ndecides = { code = 42, at_most = 2 }\n"),
              ElementsAre("6:11: error: decides wants code or codes, and at_least or at_most",
                          "8:11: error: decides wants code or codes, and at_least or at_most",
                          HasSubstr("error: code = 42 is above 41")));
}

TEST(ProfileErrors, NoneMayBeAskedFor) {
  EXPECT_THAT(ErrorsOf(kHold + "[[expect]]\nno_unexpected_rejection = { at_most = 0 }\n"
                               "[[expect]]\nentry_age = { at_most_days = 0 }\n"
                               "[[expect]]\ntable_complete = {}\n"
                               "[[expect]]\nup_down = { within_mdps = 5 }\n"
                               "[[expect]]\nresidual_rate = { within_mdps = 9, from_degc = 3 }\n"),
              ElementsAre());
}

}  // namespace
}  // namespace zrobench
