// docs/patent-map.md names a test for every claim and block; each must exist.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace {

std::string Slurp(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::set<std::string> FindAll(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

const std::filesystem::path kRoot = ZROBENCH_SOURCE_DIR;

std::set<std::string> WrittenTests() {
  std::set<std::string> tests;
  for (const auto& file : std::filesystem::directory_iterator(kRoot / "tests/unit/corrector")) {
    if (file.path().extension() != ".cc") continue;
    tests.merge(FindAll(Slurp(file.path()), std::regex(R"(TEST\(Patent, (\w+)\))")));
  }
  return tests;
}

TEST(PatentMap, NamesExistingTestsAndAllOfThem) {
  const std::string map = Slurp(kRoot / "docs/patent-map.md");
  EXPECT_EQ(FindAll(map, std::regex(R"(`((?:Claim|Fig)\w+_\w+)`)")), WrittenTests());
}

TEST(PatentMap, CoversEveryClaimAndBlock) {
  const std::string map = Slurp(kRoot / "docs/patent-map.md");
  for (int claim = 1; claim <= 13; ++claim) {
    EXPECT_NE(map.find("`Claim" + std::to_string(claim) + "_"), std::string::npos) << claim;
  }
  for (const char* block :
       {"Fig4Block34", "Fig4Block36", "Fig4Block38And40", "Fig4Block42", "Fig4Block44",
        "Fig4Block46", "Fig5Block54", "Fig5Block56", "Fig5Block57", "Fig5Block58", "Fig5Block59"}) {
    EXPECT_NE(map.find(block), std::string::npos) << block;
  }
}

TEST(PatentMap, NamesExistingFiles) {
  const std::string map = Slurp(kRoot / "docs/patent-map.md");
  const auto files = FindAll(map, std::regex(R"(`(corrector/[\w/]+\.(?:h|cc)))"));
  EXPECT_GT(files.size(), 5u);
  for (const std::string& file : files) EXPECT_TRUE(std::filesystem::exists(kRoot / file)) << file;
}

}  // namespace
