// Every shipped profile, found in the folder, as a user runs it, on three seeds. quick-look has its
// own tests in run_test.cc.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/e2e/program.h"

namespace zrobench {
namespace {

const std::filesystem::path kProgram = ZROBENCH_PROGRAM;
const std::filesystem::path kProfiles = ZROBENCH_SOURCE_DIR "/profiles";

std::vector<std::string> ShippedProfiles() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kProfiles)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedProfile : public testing::TestWithParam<std::string> {};

TEST_P(ShippedProfile, PassesOnSeedsOneToThree) {
  for (const char* seed : {"1", "2", "3"}) {
    const TemporaryFolder folder;
    const ProgramResult result = RunProgram(
        kProgram,
        {"run", (kProfiles / (GetParam() + ".toml")).string(), "--seed", seed, "--ui", "none"},
        folder.path());
    EXPECT_EQ(result.exit_code, 0) << "seed " << seed << "\n" << result.out << result.err;
    EXPECT_THAT(result.out, testing::HasSubstr(", 0 failed, 0 skipped")) << "seed " << seed;
    EXPECT_THAT(result.out, testing::Not(testing::HasSubstr("alarm"))) << "seed " << seed;
  }
}

TEST_P(ShippedProfile, IsNamedAsItsFileAndListedInTheReadme) {
  const std::string text = ReadText(kProfiles / (GetParam() + ".toml"));
  EXPECT_THAT(text, testing::HasSubstr("\nname = \"" + GetParam() + "\"\n"));
  EXPECT_THAT(ReadText(kProfiles / "README.md"),
              testing::HasSubstr("| `" + GetParam() + ".toml` |"));
}

INSTANTIATE_TEST_SUITE_P(Profiles, ShippedProfile, testing::ValuesIn(ShippedProfiles()),
                         [](const auto& profile) {
                           std::string name = profile.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace zrobench
