// What a wrong station file says: every fault, with its place.
#include <gmock/gmock.h>

#include "rig/station/station.h"
#include "tests/unit/core/toml_text.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> ErrorsOf(const std::string& text) {
  const TextFile file(text);
  const Result<Station> station = LoadStation(file.path());
  if (station) return {};
  EXPECT_EQ(station.error().kind, Error::Kind::kConfig);
  return LinesWithoutPath(station.error().message, file.path());
}

TEST(StationErrors, AllAtOnceInFileOrder) {
  EXPECT_THAT(
      ErrorsOf("[station]\n"
               "nam = \"bench\"\n"
               "[instruments]\n"
               "plate = \"modbus-tcp://host\"\n"
               "board = 7\n"
               "[limits]\n"
               "max_degc = nan\n"
               "max_rate_degc_per_s = 1\n"
               "min_tone_hz = -5\n"
               "[clock]\n"
               "speed = inf\n"
               "[virtual]\n"
               "gyro_range_dps = 300\n"
               "controller = { kp_pct_per_k = 20, kp = 3 }\n"
               "[modle]\n"),
      ElementsAre(
          "1:1: error: 'name' is missing in [station]",
          "2:1: error: 'nam' is not a key of [station]; did you mean 'name'?",
          "4:9: error: modbus-tcp:// wants HOST:PORT",
          "5:9: error: board must be a text, not a number",
          "7:12: error: max_degc must be a finite number",
          "8:1: error: 'max_rate_degc_per_s' is not a key of [limits]; wrong unit, write it "
          "in degc_per_min as 'max_rate_degc_per_min'",
          "9:15: error: min_tone_hz = -5 is below 0.1",
          "11:9: error: speed must be a finite number",
          "13:18: error: gyro_range_dps = 300 is not one of 125, 250, 500, 1000, 2000, 4000",
          "14:35: error: 'kp' is not a key of controller; with its unit it is "
          "'kp_pct_per_k'",
          "15:2: error: 'modle' is not a key of a station file; did you mean 'model'?"));
}

TEST(StationErrors, TheModelIsCheckedByThePhysics) {
  EXPECT_THAT(ErrorsOf("station = { name = \"s\" }\n"
                       "[model]\n"
                       "terms = [\"acoustic.resonanse\"]\n"
                       "[model.plate]\n"
                       "heat_capacity_j_per_k = 0\n"
                       "heater_kw = 0.1\n"
                       "[model.gyro]\n"
                       "zro_x_dps = [1, 2, 3, 4, 5]\n"
                       "zro_y_dps = [1, \"2\"]\n"
                       "[model.term.\"acoustic.resonance\"]\n"
                       "resonance_hz = [1.0, 2.0]\n"
                       "colour = 3\n"),
              ElementsAre(HasSubstr("3:9: error: model.terms names the unknown term"),
                          "5:25: error: heat_capacity_j_per_k = 0 is below 0.001",
                          HasSubstr("6:1: error: 'heater_kw' is not a key of [model.plate]; "
                                    "did you mean 'heater_w'?"),
                          "8:13: error: zro_x_dps must hold 1 to 4 numbers, not 5",
                          "9:17: error: zro_y_dps[1] must be a number, not a text",
                          HasSubstr("11:16: error: model.term.\"acoustic.resonance\".resonance_hz"),
                          HasSubstr("12:10: error: model.term.\"acoustic.resonance\".colour")));
}

TEST(StationErrors, BrokenTomlHasAPlace) {
  EXPECT_THAT(ErrorsOf("[station]\nname = \"open\nmax = 1\n"),
              ElementsAre(HasSubstr("2:13: error: ")));
}

TEST(StationErrors, AnUpsideDownRangeIsRefused) {
  EXPECT_THAT(ErrorsOf("station.name = \"s\"\n[limits]\nmin_degc = 50\nmax_degc = 40\n"),
              ElementsAre("3:12: error: min_degc = 50 is not below max_degc = 40"));
}

TEST(StationErrors, AnEmptyFileLacksItsName) {
  EXPECT_THAT(ErrorsOf(""), ElementsAre(HasSubstr("error: 'station' is missing")));
}

TEST(StationErrors, ADateMustBeOne) {
  const std::string head = "station.name = \"s\"\n[virtual]\n";
  EXPECT_THAT(ErrorsOf(head + "epoch = \"tomorrow\"\n"),
              ElementsAre(HasSubstr("3:9: error: epoch")));
  EXPECT_THAT(ErrorsOf(head + "epoch = 12:30:00\n"), ElementsAre(HasSubstr("3:9: error: epoch")));
  EXPECT_THAT(ErrorsOf(head + "epoch = 1969-12-31\n"), ElementsAre(HasSubstr("3:9: error: epoch")));
}

TEST(StationErrors, AMissingFileSaysSo) {
  const Result<Station> station = LoadStation("no/such/station.toml");
  ASSERT_FALSE(station);
  EXPECT_EQ(station.error().kind, Error::Kind::kFile);
  EXPECT_EQ(station.error().message,
            "no/such/station.toml: error: cannot read it: No such file or directory");
  const Result<Station> folder = LoadStation("/tmp");
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().message, HasSubstr("is a directory"));
}

TEST(StationErrors, AbsurdlySmallNumbersAreSaidToBe) {
  EXPECT_THAT(ErrorsOf("station = { name = \"s\" }\n"
                       "[limits]\n"
                       "max_rate_degc_per_min = 1e-300\n"
                       "max_tone_v = 1e-300\n"
                       "max_tone_s = 1e-300\n"
                       "[clock]\n"
                       "speed = 1e-300\n"
                       "[model.board]\n"
                       "heat_capacity_j_per_k = 1e-300\n"
                       "to_plate_w_per_k = 1e-300\n"
                       "[model.package]\n"
                       "time_constant_s = 1e-300\n"
                       "[model.speaker]\n"
                       "pa_per_v = 1e-300\n"),
              ElementsAre("3:25: error: max_rate_degc_per_min = 1e-300 is below 0.01",
                          "4:14: error: max_tone_v = 1e-300 is below 1e-06",
                          "5:14: error: max_tone_s = 1e-300 is below 0.1",
                          "7:9: error: speed = 1e-300 is below 0.001",
                          "9:25: error: heat_capacity_j_per_k = 1e-300 is below 0.001",
                          "10:20: error: to_plate_w_per_k = 1e-300 is below 1e-06",
                          "12:19: error: time_constant_s = 1e-300 is below 0.001",
                          "14:12: error: pa_per_v = 1e-300 is below 1e-06"));
}

}  // namespace
}  // namespace zrobench
