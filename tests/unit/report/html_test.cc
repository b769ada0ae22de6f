// report.html: what stands in it without a script, and that nothing of a record breaks it.
#include "rig/report/html.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "rig/report/files.h"
#include "rig/report/plots.h"
#include "rig/report/sections.h"
#include "tests/unit/report/small_record.h"

namespace zrobench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

RunManifest Manifest() {
  RunManifest m;
  m.profile = "small <profile>";
  m.station = "virtual";
  m.verdict = Verdict::kFail;
  m.checks = {
      {"table_accuracy",
       "entries within 20 mdps",
       Verdict::kFail,
       "off at 23 degC",
       {{.name = "table_accuracy.23.x",
         .value = 31.25,
         .unit = "mdps",
         .low = -20,
         .high = 20,
         .uncertainty_k2 = 2,
         .first_us = 15'000'000,
         .last_us = 25'000'000},
        {.name = "table_accuracy.21.x", .value = 1, .unit = "mdps", .low = -20, .high = 20}}}};
  return m;
}

History HistoryOf(const SmallRecord& record) { return ReadHistory(record.path()).value(); }

/// The text of the report's embedded JSON.
std::string Embedded(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"plots\">";
  const auto begin = html.find(open) + open.size();
  return html.substr(begin, html.find("</script>", begin) - begin);
}

TEST(Html, SaysVerdictAndWhyWithoutAScript) {
  const SmallRecord record;
  const std::string html = HtmlReport(Manifest(), HistoryOf(record));
  const std::string before = html.substr(0, html.find("<script"));
  EXPECT_THAT(before, AllOf(HasSubstr("<span id=\"verdict\" class=\"badge fail\">fail</span>"),
                            HasSubstr("small &lt;profile&gt;"), HasSubstr("off at 23 degC"),
                            HasSubstr("31.25 ± 2 mdps"), HasSubstr("0 passed, 1 failed")));
  EXPECT_THAT(before, HasSubstr("alarm of the rig at 50.0 s: plate &lt;does&gt; not answer"));
  EXPECT_THAT(MeasurementsHtml(Manifest(), HistoryOf(record)), HasSubstr("10.0 .. 20.0"))
      << "evidence counts from the record's start, as all times do";
}

TEST(Html, ARunWithoutVerdictSaysSo) {
  RunManifest m = Manifest();
  m.verdict.reset();
  m.checks.clear();
  m.reason = "interrupted";
  const std::string html = HtmlReport(m, History());
  EXPECT_THAT(html, AllOf(HasSubstr(">none</span>"), HasSubstr("ended early: interrupted"),
                          HasSubstr("No check was judged"), HasSubstr("No reading was refused")));
}

TEST(Html, ACutRecordSaysHowOldItsEntriesAre) {
  History h;
  h.damage = "cut at byte 7";
  h.table_s = 12.5;
  EXPECT_THAT(HtmlReport(Manifest(), h),
              HasSubstr("the record ends early: cut at byte 7; entries are those read at 12.5 s"));
}

TEST(Html, AsksNobodyForAnything) {
  const SmallRecord record;
  const std::string html = HtmlReport(Manifest(), HistoryOf(record));
  EXPECT_FALSE(std::regex_search(html, std::regex("(src|href)=\"(?!data:)")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("sourceMappingURL")));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_LT(html.size(), 400'000u);
}

TEST(Html, NamesWhatWasNotExercised) {
  const SmallRecord record;
  const std::string text = NotExercisedHtml(CoverageOf(HistoryOf(record)));
  EXPECT_THAT(text, HasSubstr("<dt>no learned entry</dt><dd>20–22.5, 25–32.5 °C</dd>"));
  EXPECT_THAT(text, HasSubstr("<dt>no entry at all</dt><dd>25–32.5 °C</dd>"));
  EXPECT_THAT(text, HasSubstr("<dt>no reading</dt><dd>20–22.5, 25–30 °C</dd>"));
  EXPECT_THAT(text, HasSubstr("<dt>axes never refused for</dt><dd>x</dd>"));
  EXPECT_THAT(text, AllOf(HasSubstr("3\u00a0bias_limit"), HasSubstr("16\u00a0test_mode"),
                          Not(HasSubstr("motion")), Not(HasSubstr("gyro_variance"))));
}

TEST(Html, EachRefusalHasTheNumbersBehindIt) {
  const SmallRecord record;
  const std::string text = RefusalsHtml(HistoryOf(record));
  EXPECT_THAT(text, HasSubstr("2 refusals, 1 of them unexpected"));
  EXPECT_THAT(text, HasSubstr("<td>24.5</td><td>24.50</td><td class=\"text\">2 gyro_variance</td>"
                              "<td>z</td><td>0.801</td><td>-1.102</td><td>0.648</td>"
                              "<td>4.5</td><td>2.5</td>"));
  EXPECT_THAT(text, HasSubstr("tone 27000 Hz 100 dB"));
  EXPECT_THAT(text, HasSubstr("<tr class=\"unexpected\"><td>55.0</td>"));
}

TEST(Plots, EmbedWhatTheRecordHolds) {
  const SmallRecord record;
  const auto plots = nlohmann::json::parse(Embedded(HtmlReport(Manifest(), HistoryOf(record))));
  EXPECT_THAT(plots["entries"], SizeIs(2));
  EXPECT_EQ(plots["entries"][0]["origin"], "factory");
  EXPECT_DOUBLE_EQ(plots["entries"][1]["zro_mdps"][1], -1100);
  EXPECT_THAT(plots["readings"], SizeIs(4));
  EXPECT_EQ(plots["readings"][0]["fate"], "accepted");
  EXPECT_EQ(plots["readings"][1]["fate"], "refused");
  EXPECT_EQ(plots["readings"][1]["stimulus"], 0);
  EXPECT_THAT(plots["cloud"], SizeIs(48)) << "the quiet ones of 57 seconds";
  EXPECT_THAT(plots["temperatures"], SizeIs(61));
  EXPECT_TRUE(plots["temperatures"][0][1].is_null()) << "nobody had commanded yet";
  EXPECT_THAT(plots["rates"], SizeIs(58)) << "57 and the gap of the power cut";
  EXPECT_DOUBLE_EQ(plots["tones"][0]["shift_mdps"][2], 300);
}

TEST(Plots, NoTextOfARecordEndsTheScript) {
  const SmallRecord record("</script><b>\xff");
  const std::string json = PlotsJson(HistoryOf(record));
  EXPECT_THAT(json, Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::json::parse(json)["stimuli"][0]["kind"], "</script><b>\xEF\xBF\xBD");
  EXPECT_THAT(HtmlReport(Manifest(), HistoryOf(record)), Not(HasSubstr("</script><b>")));
}

TEST(Files, AllThreeReportsComeFromTheFolder) {
  const SmallRecord record;
  const auto path = record.path().string() + ".run";
  std::filesystem::create_directory(path);
  std::filesystem::copy_file(record.path(), path + "/record.ulg",
                             std::filesystem::copy_options::overwrite_existing);
  const auto folder = RunFolder::Open(path);
  ASSERT_TRUE(folder);
  ASSERT_TRUE(WriteReports(*folder, Manifest()));
  for (const char* name : {"report.txt", "report.html", "junit.xml"}) {
    EXPECT_GT(std::filesystem::file_size(path + "/" + name), 200u) << name;
  }
  std::filesystem::remove(path + "/record.ulg");
  EXPECT_FALSE(WriteReports(*folder, Manifest())) << "without its record there is no report";
  std::filesystem::remove_all(path);
}

}  // namespace
}  // namespace zrobench
