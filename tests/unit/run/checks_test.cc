// Every check on evidence made by hand: pass, fail, inconclusive.
#include "rig/run/checks/checks.h"

#include <gmock/gmock.h>

#include "corrector/table.h"
#include "rig/run/run.h"
#include "tests/unit/run/fake_bench.h"

namespace zrobench {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kS = 1'000'000;

class ChecksTest : public testing::Test {
 protected:
  /// Two minutes at 25 degC: raw 0.5 dps on every axis, corrected rate 0.
  ChecksTest() {
    for (std::uint64_t s = 1; s <= 120; ++s) {
      MeanItem mean{.at_us = s * kS, .imu_degc = 25};
      mean.raw_dps.fill(0.5f + (s % 2 == 0 ? 0.001f : -0.001f));
      evidence_.seconds.push_back({mean, true});
    }
    evidence_.last_us = 120 * kS;
    evidence_.completed = true;
  }
  CheckResult Run(const std::string& check,
                  std::vector<std::pair<std::string, Expectation::Value>> arguments = {}) {
    return RunCheck({check, std::move(arguments), 1}, {evidence_, station_, "nowhere.ulg"});
  }
  void Decide(double at_s, zro::Code code, double measured_dps = 0.5) {
    Decision record{.code = code, .temp_degc = 25};
    record.measured_dps.fill(measured_dps);
    evidence_.decisions.push_back({static_cast<std::uint64_t>(at_s * 1e6), record});
  }
  static TableItem TableOf(std::uint64_t at_us, std::uint8_t when, float zro_dps,
                           zro::Origin origin = zro::Origin::kLearned) {
    return TableOf(at_us, when, {{25, zro_dps}}, origin);
  }
  static TableItem TableOf(std::uint64_t at_us, std::uint8_t when,
                           const std::vector<std::pair<float, float>>& degc_and_zro_dps,
                           zro::Origin origin = zro::Origin::kLearned) {
    zro::Table table;
    for (const auto& [degc, dps] : degc_and_zro_dps) {
      table.Insert({degc, {dps, dps, dps}, 0.001f, 1, 1, origin});
    }
    TableItem item{at_us, when, 0, {}};
    item.image.resize(zro::Table::kMaxImageBytes);
    item.image.resize(table.ToImage(1, item.image.data()));
    return item;
  }
  Evidence evidence_;
  Station station_;
};

const std::vector<std::pair<std::string, Expectation::Value>> kTone = {
    {"codes", std::vector<double>{2, 4}}, {"during", std::string("tone")}};
const std::vector<std::pair<std::string, Expectation::Value>> kWithin = {{"within_mdps", 50.0}};

TEST_F(ChecksTest, RejectsCountsInAndShortlyAfterTheStimulus) {
  evidence_.stimuli = {{10 * kS, 20 * kS, "tone"}};
  EXPECT_EQ(Run("rejects", kTone).verdict, Verdict::kFail);
  Decide(5, zro::Code::kGyroVariance);
  Decide(40, zro::Code::kGyroVariance);
  Decide(12, zro::Code::kMotion);
  EXPECT_EQ(Run("rejects", kTone).verdict, Verdict::kFail);
  Decide(24, zro::Code::kDiffersFromEntry);
  EXPECT_EQ(Run("rejects", kTone).verdict, Verdict::kPass);
}

TEST_F(ChecksTest, RejectsWithoutItsStimulusProvesNothing) {
  Decide(12, zro::Code::kGyroVariance);
  evidence_.stimuli = {{10 * kS, 20 * kS, "move tap"}};
  const CheckResult result = Run("rejects", kTone);
  EXPECT_EQ(result.verdict, Verdict::kInconclusive);
  EXPECT_THAT(result.reason, HasSubstr("no tone was played"));
}

TEST_F(ChecksTest, RejectsDoesNotBlameTheDeviceForDecisionsThatWereNotRead) {
  evidence_.stimuli = {{10 * kS, 20 * kS, "tone"}};
  evidence_.decisions_lost = 1;
  EXPECT_EQ(Run("rejects", kTone).verdict, Verdict::kInconclusive);
  Decide(12, zro::Code::kGyroVariance);
  EXPECT_EQ(Run("rejects", kTone).verdict, Verdict::kPass);
}

TEST_F(ChecksTest, RejectsWithoutCodesOrStimulusMeansAnyAnywhere) {
  EXPECT_EQ(Run("rejects").verdict, Verdict::kFail);
  Decide(60, zro::Code::kRecentNothingToDo);
  EXPECT_EQ(Run("rejects").verdict, Verdict::kFail);
  Decide(60, zro::Code::kTemperatureSlope);
  EXPECT_EQ(Run("rejects").verdict, Verdict::kPass);
}

TEST_F(ChecksTest, NoCorruptEntryFailsOnAWriteDuringAStimulusOrFarFromTheTruth) {
  evidence_.stimuli = {{10 * kS, 20 * kS, "tone"}};
  Decide(60, zro::Code::kNew);
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kPass);
  Decide(70, zro::Code::kMerged, 0.6);
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kFail);
  evidence_.decisions.pop_back();
  Decide(15, zro::Code::kMerged);
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kFail);
}

TEST_F(ChecksTest, NoCorruptEntryLooksAtASweepsReadingsByTheirErrorAlone) {
  evidence_.stimuli = {{10 * kS, 20 * kS, "sweep 26900-27100 Hz"}};
  Decide(15, zro::Code::kMerged);
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kPass);
  Decide(16, zro::Code::kMerged, 0.6);
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kFail);
}

TEST_F(ChecksTest, NoCorruptEntryNeedsSomethingToJudge) {
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kInconclusive);
  evidence_.stimuli = {{10 * kS, 20 * kS, "tone"}};  // tempted, and nothing written: as it should
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kPass);
  evidence_.decisions_lost = 2;
  EXPECT_EQ(Run("no_corrupt_entry", kWithin).verdict, Verdict::kInconclusive);
}

TEST_F(ChecksTest, TableCoverageCountsLearnedEntriesOnly) {
  const auto coverage = [&] {
    return Run("table_coverage",
               {{"from_degc", 20.0}, {"to_degc", 30.0}, {"step_degc", 5.0}, {"min_pct", 30.0}});
  };
  EXPECT_EQ(coverage().verdict, Verdict::kInconclusive);
  evidence_.tables = {TableOf(9, 3, 0.5f, zro::Origin::kFactory)};
  EXPECT_EQ(coverage().verdict, Verdict::kFail);
  evidence_.tables.push_back(TableOf(9, 3, 0.5f));
  EXPECT_EQ(coverage().verdict, Verdict::kPass);  // one of three
}

TEST_F(ChecksTest, TableAccuracyComparesWithTheLongAverage) {
  const auto accuracy = [&] {
    return Run("table_accuracy", {{"from_degc", 20.0}, {"to_degc", 30.0}, {"within_mdps", 20.0}});
  };
  EXPECT_EQ(accuracy().verdict, Verdict::kInconclusive);
  evidence_.tables = {TableOf(9, 3, 0.505f)};
  EXPECT_EQ(accuracy().verdict, Verdict::kPass);
  evidence_.tables = {TableOf(9, 3, 0.54f)};
  EXPECT_EQ(accuracy().verdict, Verdict::kFail);
  for (Second& second : evidence_.seconds) second.quiet = false;
  EXPECT_EQ(accuracy().verdict, Verdict::kInconclusive);
}

TEST_F(ChecksTest, TablePersistsComparesEveryByteOnlyWhereNothingWasPending) {
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kInconclusive);
  evidence_.tables = {TableOf(10 * kS, 1, 0.5f), TableOf(20 * kS, 2, 0.5f)};
  evidence_.cuts = {{15 * kS, true}};
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kPass);
  evidence_.tables[1] = TableOf(20 * kS, 2, 0.51f);  // a merge that was not committed?
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kFail);
  evidence_.cuts = {{5 * kS, true}, {15 * kS, false}};
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kPass);
  evidence_.cuts = {{5 * kS, false}, {15 * kS, true}};  // the other cut's pending merge is its own
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kFail);
  evidence_.tables[1].image[0] ^= 0xFF;
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kInconclusive);
}

TEST_F(ChecksTest, TablePersistsLetsMergesMoveAnEntryAlongItsBin) {
  evidence_.cuts = {{15 * kS, false}};
  evidence_.tables = {TableOf(10 * kS, 1, {{20, 0.50f}, {24.8f, 0.644f}}),
                      TableOf(20 * kS, 2, {{20, 0.50f}, {22.6f, 0.578f}})};  // 0.03 dps/degC
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kPass);
  evidence_.tables[1] = TableOf(20 * kS, 2, {{20, 0.50f}, {22.6f, 0.620f}});  // another offset
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kFail);
  evidence_.tables[1] = TableOf(20 * kS, 2, {{20, 0.50f}, {21.8f, 0.554f}});  // another bin
  EXPECT_EQ(Run("table_persists").verdict, Verdict::kFail);
}

TEST_F(ChecksTest, ResidualRateJudgesTheWorstTenQuietSeconds) {
  EXPECT_EQ(Run("residual_rate", kWithin).verdict, Verdict::kPass);
  for (std::size_t s = 40; s < 60; ++s) evidence_.seconds[s].mean.rate_dps[1] = 0.2f;
  EXPECT_EQ(Run("residual_rate", kWithin).verdict, Verdict::kFail);
  for (std::size_t s = 40; s < 60; ++s) evidence_.seconds[s].quiet = false;
  EXPECT_EQ(Run("residual_rate", kWithin).verdict, Verdict::kPass);
  for (Second& second : evidence_.seconds) second.quiet = false;
  EXPECT_EQ(Run("residual_rate", kWithin).verdict, Verdict::kInconclusive);
}

TEST_F(ChecksTest, AnUnreadableRecordIsTheRigsFault) {
  Profile profile;
  profile.expects = {{"lockstep", {}, 1}, {"residual_rate", kWithin, 2}};
  for (const CheckResult& check : JudgeRecord("nowhere.ulg", profile, station_)) {
    EXPECT_EQ(check.verdict, Verdict::kRigError);
  }
}

class JudgeRecordTest : public BenchTest {};

TEST_F(JudgeRecordTest, ARecordWithoutItsEndIsNeverHeldAgainstTheDevice) {
  Profile profile;
  profile.expects = {{"rejects", {}, 1}};  // none: would fail
  recorder_->Write(ImuSample{.at_us = 5});
  ASSERT_TRUE(recorder_->Flush());
  EXPECT_EQ(JudgeRecord(folder_ / "record.ulg", profile, station_)[0].verdict,
            Verdict::kInconclusive);
  recorder_->Write(EventItem{.at_us = 9, .kind = EventItem::Kind::kRunEnd, .text = "completed"});
  ASSERT_TRUE(recorder_->Flush());
  EXPECT_EQ(JudgeRecord(folder_ / "record.ulg", profile, station_)[0].verdict, Verdict::kFail);
}

}  // namespace
}  // namespace zrobench
