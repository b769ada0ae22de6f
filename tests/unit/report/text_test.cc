#include "rig/report/text.h"

#include <gmock/gmock.h>

#include <sstream>

namespace zrobench {
namespace {

using testing::HasSubstr;
using testing::Not;

RunManifest OneOfEach() {
  RunManifest manifest;
  manifest.profile = "quick-look";
  manifest.station = "virtual";
  manifest.verdict = Verdict::kFail;
  const auto check = [&](const std::string& name, Verdict verdict, const std::string& reason) {
    manifest.checks.push_back({name,
                               "what was asked, in words",
                               verdict,
                               reason,
                               {{.name = name + ".25.2.x",
                                 .value = -123.456,
                                 .unit = "mdps",
                                 .low = -150,
                                 .high = 150,
                                 .uncertainty_k2 = 12.34}}});
  };
  check("table_accuracy", Verdict::kPass, "");
  check("no_corrupt_entry", Verdict::kMarginal, "near");
  check("rejects", Verdict::kFail, "no refusal came");
  check("lockstep", Verdict::kInconclusive, "inputs are missing");
  return manifest;
}

TEST(Text, NoLineIsLongerThanAHundredColumns) {
  const std::string alarm = std::string(60, 'b') + " " + std::string(60, 'c');
  std::istringstream lines(FullReport(OneOfEach(), {alarm}));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Text, MarginalCountsAsPassedInconclusiveAsSkipped) {
  EXPECT_EQ(CountLine(OneOfEach()), "2 passed, 1 failed, 1 skipped");
}

TEST(Text, EveryCheckSaysItsFigureItsLimitAndWhyItIsNoPass) {
  const std::string table = VerdictTable(OneOfEach());
  EXPECT_THAT(table, HasSubstr("-123.5 +- 12 mdps (limit -150 .. 150)"));
  EXPECT_THAT(table, HasSubstr("why: no refusal came"));
  EXPECT_THAT(table, HasSubstr("verdict: fail\n"));
  EXPECT_THAT(table, Not(HasSubstr("alarm")));
}

TEST(Text, AlarmsStandBesideTheVerdict) {
  RunManifest manifest;
  manifest.verdict = Verdict::kPass;
  const std::string one = VerdictTable(manifest, {"the board rebooted"});
  EXPECT_THAT(one, HasSubstr("1 alarm of the rig"));
  EXPECT_THAT(one, HasSubstr("- the board rebooted"));
  EXPECT_THAT(one, HasSubstr("verdict: pass, with alarms"));
  EXPECT_THAT(VerdictTable(manifest, std::vector<std::string>(20, "x")), HasSubstr("12 more"));
}

TEST(Text, ARunThatDidNotEndHasNoVerdict) {
  EXPECT_THAT(VerdictTable({}), HasSubstr("verdict: none"));
}

}  // namespace
}  // namespace zrobench
