// `zrobench diagnose` as a user meets it: exit codes, one JSON object, nothing read but the columns
// and the station file.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tests/e2e/program.h"

namespace zrobench {
namespace {

using testing::HasSubstr;

constexpr const char* kStation = "schema = 1\n[station]\nname = \"logger\"\n";

/// Twenty minutes of a resting gyro that warms by itself: white noise about a line in temperature.
std::string Recording() {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.004);
  std::ostringstream csv;
  csv << "t_s,imu_degc,gyro_x_dps,note\n";
  for (int t = 1; t <= 1200; ++t) {
    const double degc = 35 - 10 * std::exp(-t / 400.0);
    csv << t << ',' << degc << ',' << 0.5 + 0.01 * (degc - 25) + noise(random) << ",ok\n";
  }
  return csv.str();
}

class Diagnose : public testing::Test {
 protected:
  ProgramResult Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "diagnose");
    return RunProgram(ZROBENCH_PROGRAM, std::move(arguments), folder_.path());
  }
  void WriteCase() const {
    folder_.Write("station.toml", kStation);
    folder_.Write("run-1.csv", Recording());
  }
  std::string folder() const { return folder_.path().string(); }
  TemporaryFolder folder_;
};

TEST_F(Diagnose, SaysWhatIsMissingInACase) {
  ProgramResult result = Run({folder()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("station.toml"));
  result = Run({});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("which case"));
}

TEST_F(Diagnose, PrintsTheCatalogue) {
  const ProgramResult result = Run({"--terms"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("gyro.creep"));
  EXPECT_THAT(result.out, HasSubstr("source:"));
}

TEST_F(Diagnose, ReadsTheColumnsAndTheStationFileAlone) {
  WriteCase();
  auto first = nlohmann::json::parse(Run({folder(), "--json"}).out);
  EXPECT_EQ(first["verdict"], "no_missing_physics");
  folder_.Write("label.json", "{\"effects\": [\"gyro.creep\"]}");
  folder_.Write("run.json", "{}");
  auto second = nlohmann::json::parse(Run({folder(), "--json"}).out);
  first.erase("seconds");
  second.erase("seconds");
  EXPECT_EQ(first, second);
}

TEST_F(Diagnose, AnExpectationThatIsNotMetIsExitSeven) {
  WriteCase();
  EXPECT_EQ(Run({folder(), "--expect", "no_missing_physics"}).exit_code, 0);
  const ProgramResult result = Run({folder(), "--expect", "named:gyro.creep"});
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_THAT(result.err, HasSubstr("no_missing_physics"));
}

}  // namespace
}  // namespace zrobench
