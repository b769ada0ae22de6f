// plan foretells what run does.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "rig/record/item_reader.h"
#include "tests/e2e/program.h"

namespace zrobench {
namespace {

const std::filesystem::path kProgram = ZROBENCH_PROGRAM;

TEST(Plan, ForetellsTheDurationOfEveryShippedProfileWithinFivePercent) {
  int profiles = 0;
  for (const auto& file : std::filesystem::directory_iterator(ZROBENCH_SOURCE_DIR "/profiles")) {
    if (file.path().extension() != ".toml") continue;
    ++profiles;
    const TemporaryFolder folder;
    const std::string profile = file.path().string();
    const ProgramResult plan = RunProgram(kProgram, {"plan", profile, "--json"}, folder.path());
    ASSERT_EQ(plan.exit_code, 0) << plan.err;
    EXPECT_TRUE(OnlyRun(folder.path()).empty()) << "a plan leaves nothing behind";
    const auto json = nlohmann::json::parse(plan.out);
    RunProgram(kProgram, {"run", profile, "--seed", "5", "--ui", "none"}, folder.path());
    double real_s = 0;
    ASSERT_TRUE(ReadItems(OnlyRun(folder.path()) / "record.ulg", [&](const auto& item) {
      real_s = std::max(real_s, static_cast<double>(item.at_us) * 1e-6);
    }));
    EXPECT_NEAR(json.at("duration_s").get<double>(), real_s, 0.05 * real_s) << profile;
  }
  EXPECT_GE(profiles, 7);
}

TEST(Plan, NamesTheRefusalsThatTheStimuliOfQuickLookProvoke) {
  const TemporaryFolder folder;
  const ProgramResult plan = RunProgram(kProgram, {"plan", "--json"}, folder.path());
  const auto json = nlohmann::json::parse(plan.out);
  int stimuli = 0;
  for (const auto& step : json.at("steps")) {
    for (const auto& stimulus : step.at("stimuli")) {
      ++stimuli;
      EXPECT_FALSE(stimulus.at("refusals").empty()) << stimulus.dump();
    }
  }
  EXPECT_EQ(stimuli, 3);
  EXPECT_GE(json.at("entries_degc").size(), 8u);
  EXPECT_EQ(json.at("halted"), "");
}

TEST(Plan, AnInvalidProfileIsRefusedLikeInARun) {
  const TemporaryFolder folder;
  const auto profile = folder.Write("bad.toml", "schema = 1\nname = \"x\"\n[[step]]\nhop = {}\n");
  const ProgramResult plan = RunProgram(kProgram, {"plan", profile.string()}, folder.path());
  EXPECT_EQ(plan.exit_code, 2);
  EXPECT_NE(plan.err.find("bad.toml:4:"), std::string::npos) << plan.err;
}

}  // namespace
}  // namespace zrobench
