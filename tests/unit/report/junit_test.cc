// junit.xml: read back by a parser that is not ours where one is installed, and by its content.
#include "rig/report/junit.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "rig/report/markup.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

CheckResult Check(std::string name, std::string about, Verdict verdict, std::string reason = {}) {
  return {std::move(name), std::move(about), verdict, std::move(reason), {}};
}

/// Every verdict, each a different number of times, two checks of a kind, and texts that would
/// break careless markup.
RunManifest EveryVerdict() {
  RunManifest m;
  m.profile = "quick & <dirty>";
  m.station = "virtual";
  m.version = "0.1.0";
  m.host = "bench\x01-\xff";
  m.seed = 7;
  m.started = 1'767'225'600'000'000'000;
  m.ended = m.started + 486'250'000'000;
  m.verdict = Verdict::kFail;
  m.checks = {
      Check("table_coverage", "entries", Verdict::kPass),
      Check("rejects", "refused with code 2 during tone", Verdict::kFail, "0 refusals \"<2>\""),
      Check("rejects", "refused with code 1 during hand_held", Verdict::kInconclusive,
            "no hand_held was played"),
      Check("residual_rate", "near zero", Verdict::kMarginal, "the uncertainty reaches the limit"),
      Check("lockstep", "host agrees", Verdict::kRigError, "frames lost: 3"),
  };
  for (const Verdict verdict : {Verdict::kPass, Verdict::kPass, Verdict::kPass, Verdict::kFail,
                                Verdict::kInconclusive, Verdict::kInconclusive}) {
    m.checks.push_back(Check("more", std::to_string(m.checks.size()), verdict));
  }
  m.checks[1].measurements = {{.name = "rejects.tone",
                               .value = 0,
                               .unit = "1",
                               .low = 1,
                               .first_us = 100'000'000,
                               .last_us = 128'500'000}};
  m.checks[3].measurements = {{.name = "residual_rate.x",
                               .value = 39.5,
                               .unit = "mdps",
                               .high = 40,
                               .uncertainty_k2 = 1.4,
                               .first_us = 0,
                               .last_us = 10'000'000}};
  return m;
}

/// What `xmllint ARGUMENTS FILE` prints; empty when it finds fault.
std::string Xmllint(const std::string& arguments, const std::string& xml) {
  const auto stem =
      std::filesystem::temp_directory_path() / ("zrobench-junit-" + std::to_string(::getpid()));
  const std::string in = stem.string() + ".xml", out = stem.string() + ".txt";
  std::ofstream(in, std::ios::binary) << xml;
  const int status = std::system(("xmllint --nonet " + arguments + " " + in + " >" + out).c_str());
  std::ifstream file(out, std::ios::binary);
  std::string said{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(in);
  std::filesystem::remove(out);
  return status == 0 ? said : "";
}

#define NEEDS_XMLLINT()                                         \
  if (std::system("command -v xmllint >/dev/null 2>&1") != 0) { \
    GTEST_SKIP() << "xmllint (libxml2-utils) is not installed"; \
  }                                                             \
  static_assert(true, "")

TEST(JUnit, IsWellFormedWhateverTheTexts) {
  NEEDS_XMLLINT();
  RunManifest m = EveryVerdict();
  for (int c = 0; c < 256; ++c) m.checks[1].reason += static_cast<char>(c);
  m.checks[1].reason += "\xEF\xBF\xBF \xED\xA0\x80 \xC0\x80 \xE2\x82\xAC";
  EXPECT_THAT(Xmllint("--noout --xpath 'string(//testcase[2]/failure/@message)'", JUnitXml(m)),
              HasSubstr("\xE2\x82\xAC"));
  EXPECT_THAT(Xmllint("--xpath 'string(//testsuite/@name)'", JUnitXml(m)),
              HasSubstr("quick & <dirty>"));
}

TEST(JUnit, AnXmlParserCountsWhatTheSuiteDeclares) {
  NEEDS_XMLLINT();
  const std::string xml = JUnitXml(EveryVerdict());
  const auto number = [&](const std::string& xpath) {
    return Xmllint("--xpath 'string(" + xpath + ")'", xml);
  };
  EXPECT_THAT(number("count(//testcase)=//testsuite/@tests and //testsuite/@tests=11"),
              HasSubstr("true"));
  EXPECT_THAT(number("count(//testcase/failure)=//testsuite/@failures and count(//failure)=2"),
              HasSubstr("true"));
  EXPECT_THAT(number("count(//testcase/error)=//testsuite/@errors and count(//error)=1"),
              HasSubstr("true"));
  EXPECT_THAT(number("count(//testcase/skipped)=//testsuite/@skipped and count(//skipped)=3"),
              HasSubstr("true"));
}

TEST(JUnit, EachVerdictHasItsElementAndItsReason) {
  const std::string xml = JUnitXml(EveryVerdict());
  EXPECT_THAT(xml, HasSubstr("tests=\"11\" failures=\"2\" errors=\"1\" skipped=\"3\""));
  EXPECT_THAT(xml, HasSubstr("<failure type=\"fail\" message=\"0 refusals &quot;&lt;2&gt;&quot;; "
                             "rejects.tone: 0 (limit &gt;= 1)\">"));
  EXPECT_THAT(xml, HasSubstr("<error type=\"rig_error\" message=\"frames lost: 3; "));
  EXPECT_THAT(xml, HasSubstr("<skipped message=\"inconclusive: no hand_held was played; "));
  EXPECT_THAT(xml, HasSubstr("<system-out>marginal: the uncertainty reaches the limit; "
                             "residual_rate.x: 39.5 +- 1.4 mdps (limit &lt;= 40)</system-out>"));
}

TEST(JUnit, MeasurementsArePropertiesWithUnitLimitAndUncertainty) {
  const std::string xml = JUnitXml(EveryVerdict());
  EXPECT_THAT(xml, HasSubstr("<property name=\"residual_rate.x\" value=\"39.5 mdps, limit &lt;= "
                             "40, uncertainty 1.4 (k = 2)\"/>"));
  EXPECT_THAT(xml,
              HasSubstr("<property name=\"rejects.tone\" value=\"0, limit &gt;= 1, exact\"/>"));
  EXPECT_THAT(xml, HasSubstr("<property name=\"seed\" value=\"7\"/>"));
}

TEST(JUnit, TimesAreBenchSeconds) {
  const std::string xml = JUnitXml(EveryVerdict());
  EXPECT_THAT(xml, HasSubstr("time=\"486.250\" timestamp=\"2026-01-01T00:00:00\""));
  EXPECT_THAT(xml, HasSubstr("<testcase name=\"rejects during tone\" classname=\"zrobench.quick "
                             "&amp; &lt;dirty&gt;\" time=\"28.500\">"));
}

TEST(JUnit, ACutRunIsAnError) {
  RunManifest m = EveryVerdict();
  m.checks.clear();
  m.verdict.reset();
  m.ended.reset();
  m.reason = "interrupted";
  const std::string xml = JUnitXml(m);
  EXPECT_THAT(xml, HasSubstr("tests=\"1\" failures=\"0\" errors=\"1\""));
  EXPECT_THAT(xml, HasSubstr("message=\"interrupted; nothing was measured\""));
  EXPECT_THAT(JUnitXml(EveryVerdict()), Not(HasSubstr("run to its end")));
}

TEST(JUnit, NamesAreUniqueAndShortWhereTheyCanBe) {
  const auto any = Verdict::kPass;
  EXPECT_THAT(
      CaseNames({Check("lockstep", "agrees", any), Check("rejects", "code 2 during tone", any),
                 Check("rejects", "code 1 during tap", any),
                 Check("table_accuracy", "20 to 30", any), Check("table_accuracy", "30 to 40", any),
                 Check("same", "x", any), Check("same", "x", any)}),
      ElementsAre("lockstep", "rejects during tone", "rejects during tap",
                  "table_accuracy: 20 to 30", "table_accuracy: 30 to 40", "same: x",
                  "same: x (2)"));
  EXPECT_THAT(CaseNames({Check("rejects", "code 2 during tone", any),
                         Check("rejects", "code 1 during tone", any)}),
              ElementsAre("rejects: code 2 during tone", "rejects: code 1 during tone"));
}

TEST(Markup, OnlyWhatWouldHarmIsReplaced) {
  EXPECT_EQ(Escaped("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  EXPECT_EQ(Escaped("\xC2\xB0"
                    "C \xE2\x82\xAC"),
            "\xC2\xB0"
            "C \xE2\x82\xAC");
  EXPECT_EQ(Escaped("a\tb\nc\x01"
                    "d\x7f"),
            "a&#9;b&#10;c\xEF\xBF\xBD"
            "d\xEF\xBF\xBD");
  EXPECT_EQ(Escaped("\xEF\xBF\xBE!\xff!"), "\xEF\xBF\xBD!\xEF\xBF\xBD!");
}

}  // namespace
}  // namespace zrobench
