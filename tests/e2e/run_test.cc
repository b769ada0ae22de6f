// The main job as a user sees it: the program, its exit code, its last line, its folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "rig/record/item_reader.h"
#include "tests/e2e/program.h"

namespace zrobench {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

const std::filesystem::path kProgram = ZROBENCH_PROGRAM;
const std::string kProfiles = ZROBENCH_SOURCE_DIR "/profiles/";

std::string LastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin + 1, end - begin);
}

class RunTest : public testing::Test {
 protected:
  ProgramResult Run(std::vector<std::string> arguments) {
    return RunProgram(kProgram, std::move(arguments), folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(RunTest, TheDefaultRunPassesEveryCheckAndSaysSoInItsLastLine) {
  const ProgramResult result = Run({"run"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(LastLine(result.out), MatchesRegex("[0-9]+ passed, 0 failed, 0 skipped"));
  EXPECT_THAT(result.out, HasSubstr("verdict: "));
  const auto run = OnlyRun(folder_.path());
  for (const char* file :
       {"record.ulg", "run.json", "profile.toml", "station.toml", "report.txt"}) {
    EXPECT_TRUE(std::filesystem::exists(run / file)) << file;
    EXPECT_GT(std::filesystem::file_size(run / file), 100u) << file;
  }
  EXPECT_EQ(ReadText(run / "profile.toml"), ReadText(kProfiles + "quick-look.toml"));
  EXPECT_THAT(result.out, HasSubstr("report.txt"));
  EXPECT_THAT(result.err, HasSubstr("eta "));
}

TEST_F(RunTest, TheReadmeShowsThisVeryOutput) {
  const ProgramResult result = Run({"run"});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_THAT(ReadText(ZROBENCH_SOURCE_DIR "/README.md"), HasSubstr(result.out));
}

TEST_F(RunTest, QuickLookTakesAtMostTenMinutesOfBenchTimeAndItsTableFills) {
  ASSERT_EQ(Run({"run", "--ui", "none"}).exit_code, 0);
  std::uint64_t last_us = 0;
  std::size_t entries = 0, rejections = 0;
  const auto end = ReadItems(OnlyRun(folder_.path()) / "record.ulg", [&](const auto& item) {
    using T = std::decay_t<decltype(item)>;
    last_us = std::max(last_us, item.at_us);
    if constexpr (std::is_same_v<T, TableItem>) entries = (item.image.size() - 16) / 24;
    if constexpr (std::is_same_v<T, BusFrame>) rejections += item.id == 0x90;
  });
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_LE(last_us, 600'000'000u);
  EXPECT_GE(entries, 3u + 7u);
  EXPECT_GE(rejections, 2u);
}

TEST_F(RunTest, OtherSeedsPassToo) {
  for (int seed = 2; seed <= 6; ++seed) {
    const ProgramResult result = Run({"run", "--seed", std::to_string(seed), "--ui", "none"});
    EXPECT_EQ(result.exit_code, 0) << "seed " << seed << "\n" << result.out;
  }
}

TEST_F(RunTest, TheSameSeedGivesTheSameBytes) {
  const auto record = [&](const char* seed) {
    const TemporaryFolder folder;
    EXPECT_EQ(
        RunProgram(kProgram, {"run", "--seed", seed, "--ui", "none"}, folder.path()).exit_code, 0);
    return ReadText(OnlyRun(folder.path()) / "record.ulg");
  };
  const std::string first = record("11");
  EXPECT_GT(first.size(), 1'000'000u);
  EXPECT_TRUE(first == record("11"));
  EXPECT_FALSE(first == record("12"));
}

TEST_F(RunTest, JsonIsOneObjectAndNothingElse) {
  const ProgramResult result = Run({"run", "--json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("schema"), 1);
  EXPECT_FALSE(json.at("checks").empty());
  EXPECT_EQ(json.at("exit_code"), 0);
}

TEST_F(RunTest, WhatIsWrongInAProfileIsSaidWithItsPlaceAndNothingMoves) {
  const auto profile =
      folder_.Write("bad.toml",
                    "schema = 1\nname = \"bad\"\nabout = \"x\"\n"
                    "[[step]]\nramp = { to_degc = 500.0, rate_degc_per_min = 1.0 }\n"
                    "[[step]]\nhold = { for_sec = 3 }\n");
  const ProgramResult result = Run({"run", profile.string()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("bad.toml:5:"));
  EXPECT_THAT(result.err, HasSubstr("bad.toml:7:"));
  EXPECT_THAT(result.err, HasSubstr("for_s"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "runs"));
}

TEST_F(RunTest, BelowTheDewPointOnlyWithDryGas) {
  const auto profile = folder_.Write("cold.toml",
                                     "schema = 1\nname = \"cold\"\nabout = \"x\"\n"
                                     "[[step]]\nramp = { to_degc = 5.0, rate_degc_per_min = 9 }\n"
                                     "[[expect]]\nlockstep = {}\n");
  EXPECT_EQ(Run({"run", profile.string(), "--ui", "none"}).exit_code, 0);  // the station is dry
  std::filesystem::remove_all(folder_.path() / "runs");
  std::string station = ReadText(kProfiles + "stations/virtual.toml");
  station.replace(station.find("purge = true"), 12, "purge = false");
  const auto humid = folder_.Write("wet.toml", station);
  const ProgramResult wet = Run({"run", profile.string(), "--station", humid.string()});
  EXPECT_EQ(wet.exit_code, 2);
  EXPECT_THAT(wet.err, HasSubstr("cold.toml:5:"));
  EXPECT_THAT(wet.err, HasSubstr("dew point of 8.7 degC"));  // 23 degC, 40 %RH
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "runs"));
}

TEST_F(RunTest, WithJsonARefusalIsAnObjectToo) {
  const ProgramResult result = Run({"run", "nowhere.toml", "--json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(nlohmann::json::parse(result.out).at("exit_code"), 2);
}

TEST_F(RunTest, AFullDiskIsTheRigsFaultAndIsSaid) {
  const ProgramResult result =
      RunProgram("/bin/sh", {"-c", "ulimit -f 1000; exec " + kProgram.string() + " run --ui none"},
                 folder_.path());
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  EXPECT_THAT(LastLine(result.out), MatchesRegex("0 passed, 0 failed, [0-9]+ skipped"));
  const auto json = nlohmann::json::parse(ReadText(OnlyRun(folder_.path()) / "run.json"));
  EXPECT_EQ(json.at("verdict"), "rig_error");
  EXPECT_THAT(json.at("reason").get<std::string>(), HasSubstr("record.ulg"));
}

TEST_F(RunTest, AReaderThatGoesAwayDoesNotEndTheRun) {
  const ProgramResult result =
      RunProgram("/bin/sh",
                 {"-c", "{ " + kProgram.string() +
                            " run; echo $? >code; } 2>&1 | head -n 1 >/dev/null; "
                            "exit $(cat code)"},
                 folder_.path());
  EXPECT_EQ(result.exit_code, 0);
}

TEST_F(RunTest, MissingFilesAndUnknownOptionsAreUsageErrors) {
  const ProgramResult missing = Run({"run", "nowhere.toml"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("nowhere.toml"));
  EXPECT_EQ(Run({"run", "--station", "nowhere.toml"}).exit_code, 2);
  EXPECT_EQ(Run({"run", "--sed", "3"}).exit_code, 2);
  EXPECT_EQ(Run({"dance"}).exit_code, 2);
  EXPECT_EQ(Run({"run", folder_.path().string()}).exit_code, 2);
}

TEST_F(RunTest, ARunFolderThatCannotBeMadeIsTheRigsFault) {
  const ProgramResult result = Run({"run", "--runs", "/proc/nowhere", "--ui", "none"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("/proc/nowhere"));
}

TEST_F(RunTest, EveryHelpBeginsWithAnExample) {
  for (const char* verb : {"run", "check", "plan", "replay", "report"}) {
    EXPECT_THAT(Run({verb, "--help"}).out.substr(0, 200), HasSubstr("Example: zrobench ")) << verb;
  }
}

constexpr const char* kLongProfile =
    "schema = 1\nname = \"long\"\nabout = \"a week\"\n"
    "[[step]]\nhold = { for_s = 500000 }\n[[expect]]\nlockstep = {}\n";

TEST_F(RunTest, AnInterruptStopsTheRunMakesSafeAndSaysSo) {
  const auto profile = folder_.Write("long.toml", kLongProfile);
  Program program(kProgram, {"run", profile.string()}, folder_.path());
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  program.Signal(SIGINT);
  const ProgramResult result = program.Wait();
  EXPECT_EQ(result.exit_code, 130) << result.err;
  const auto json = nlohmann::json::parse(ReadText(OnlyRun(folder_.path()) / "run.json"));
  EXPECT_EQ(json.at("exit_code"), 130);
  EXPECT_THAT(json.at("reason").get<std::string>(), HasSubstr("request"));
  for (const auto& check : json.at("checks")) EXPECT_EQ(check.at("verdict"), "inconclusive");
}

TEST_F(RunTest, AKilledRunLeavesAReadableRecordAndNoVerdict) {
  const auto profile = folder_.Write("long.toml", kLongProfile);
  Program program(kProgram, {"run", profile.string()}, folder_.path());
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  program.Signal(SIGKILL);
  EXPECT_EQ(program.Wait().exit_code, 128 + SIGKILL);
  const auto run = OnlyRun(folder_.path());
  const auto json = nlohmann::json::parse(ReadText(run / "run.json"));
  EXPECT_TRUE(!json.contains("verdict") || json.at("verdict").is_null());
  std::uint64_t samples = 0;
  const auto end = ReadItems(run / "record.ulg", [&](const auto& item) {
    samples += std::is_same_v<std::decay_t<decltype(item)>, ImuSample>;
  });
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_GT(samples, 1000u);
}

}  // namespace
}  // namespace zrobench
