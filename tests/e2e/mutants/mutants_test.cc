// Tests for the profiles: each broken corrector must fail one that is shipped, by the check that
// watches for it. Host and board run the same broken code, so lockstep cannot be what notices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/e2e/program.h"

namespace zrobench {
namespace {

struct Case {
  std::string mutant, profile;
  std::string caught_by;  ///< one of the checks that must fail
};

const std::vector<Case> kCases = {
    {"sign", "quick-look", "residual_rate"},
    {"no_figure_5", "quick-look", "no_corrupt_entry"},
    {"no_figure_5", "motion-sanity", "no_corrupt_entry"},
    {"no_sanity_check", "quick-look", "no_corrupt_entry"},
    {"no_sanity_check", "acoustic-sanity", "no_corrupt_entry"},
    {"no_sanity_check", "acoustic-short", "no_corrupt_entry"},
    {"no_stillness", "quick-look", "rejects"},
    {"no_stillness", "motion-sanity", "rejects"},
    {"store_never_written", "quick-look", "table_persists"},
    {"store_never_written", "power-cycle", "table_persists"},
    {"wrong_axis", "quick-look", "residual_rate"},
    {"unlimited_extrapolation", "factory-only", "extrapolation_held"},
    {"stale_table", "ageing", "entry_age"},
    {"dates_ignored", "thermal-sweep", "entry_age"},
    {"dates_ignored", "ageing", "decides"},
    {"overwrites_recent", "thermal-sweep", "decides"},
    {"plate_temperature", "device-load", "table_coverage"},
    {"plate_temperature", "device-load", "residual_rate"},
    {"plate_temperature", "device-load", "decides"},
    {"room_temperature", "device-load", "decides"},
};

std::set<std::string> FailedChecks(const std::string& report) {
  std::set<std::string> failed;
  const auto json = nlohmann::json::parse(report);
  for (const auto& check : json.at("checks")) {
    if (check.at("verdict") == "fail") failed.insert(check.at("check"));
  }
  return failed;
}

std::string Joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

TEST(Mutants, EachFailsAProfileByTheCheckThatWatchesForIt) {
  std::printf("%-24s %-16s %s\n", "mutant", "profile", "failed checks");
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.mutant + " x " + c.profile);
    const TemporaryFolder folder;
    const ProgramResult result = RunProgram(
        std::filesystem::path(ZROBENCH_MUTANTS) / ("mutant_" + c.mutant),
        {"run", std::string(ZROBENCH_PROFILES "/") + c.profile + ".toml", "--json"}, folder.path());
    EXPECT_EQ(result.exit_code, 1) << result.err;
    const std::set<std::string> failed = FailedChecks(result.out);
    std::printf("%-24s %-16s %s\n", c.mutant.c_str(), c.profile.c_str(), Joined(failed).c_str());
    EXPECT_TRUE(failed.contains(c.caught_by)) << "not " << c.caught_by;
    EXPECT_FALSE(failed.contains("lockstep"));
  }
}

}  // namespace
}  // namespace zrobench
