// Tests for the profile: quick-look must fail every broken corrector, and by the check that watches
// for it. Host and board run the same broken code, so lockstep cannot be what notices.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/e2e/program.h"

namespace zrobench {
namespace {

struct Mutant {
  std::string name;
  std::string caught_by;  ///< one of the checks that must fail
};

void PrintTo(const Mutant& mutant, std::ostream* out) { *out << mutant.name; }

class Mutants : public testing::TestWithParam<Mutant> {};

TEST_P(Mutants, QuickLookFailsIt) {
  const TemporaryFolder folder;
  const std::filesystem::path binary =
      std::filesystem::path(ZROBENCH_MUTANTS) / ("mutant_" + GetParam().name);
  const ProgramResult result = RunProgram(binary, {"run", "--json"}, folder.path());
  EXPECT_EQ(result.exit_code, 1) << result.err;
  std::vector<std::string> failed;
  const auto json = nlohmann::json::parse(result.out);
  for (const auto& check : json.at("checks")) {
    if (check.at("verdict") == "fail") failed.push_back(check.at("check"));
    if (check.at("check") == "lockstep") {
      EXPECT_EQ(check.at("verdict"), "pass");
    }
  }
  EXPECT_NE(std::find(failed.begin(), failed.end(), GetParam().caught_by), failed.end())
      << "failed: " << testing::PrintToString(failed);
}

INSTANTIATE_TEST_SUITE_P(QuickLook, Mutants,
                         testing::Values(Mutant{"sign", "residual_rate"},
                                         Mutant{"no_figure_5", "no_corrupt_entry"},
                                         Mutant{"no_sanity_check", "no_corrupt_entry"},
                                         Mutant{"no_stillness", "rejects"},
                                         Mutant{"store_never_written", "table_persists"}),
                         [](const auto& mutant) { return mutant.param.name; });

}  // namespace
}  // namespace zrobench
