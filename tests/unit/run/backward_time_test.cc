// A clock that goes backwards: the board's, the bus's, the wall's. Each is said for what it is, and
// none of them is held against the device.
#include <gmock/gmock.h>

#include "corrector/node/codec.h"
#include "rig/run/bus_tap.h"
#include "rig/run/checks/checks.h"
#include "rig/run/run.h"
#include "tests/unit/run/fake_bench.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class BackwardTimeTest : public BenchTest {
 protected:
  void DeviceTime(BusTap& tap, std::uint32_t us) {
    zro::node::TimeMsg time{};
    time.sample_time_us = us;
    tap.OnFrame({Encode(time), clock_.now(), false});
  }
  std::vector<CheckResult> Judged(std::vector<Expectation> expects) {
    Profile profile;
    profile.expects = std::move(expects);
    EXPECT_TRUE(recorder_->Flush());
    return JudgeRecord(folder_ / "record.ulg", profile, station_);
  }
  void End() { recorder_->Write(EventItem{.kind = EventItem::Kind::kRunEnd, .text = "completed"}); }
};

TEST_F(BackwardTimeTest, ABoardWhoseCounterGoesBackWithoutABootMakesInputsLost) {
  BusTap tap(*log_);
  DeviceTime(tap, 4'294'900'000u);
  DeviceTime(tap, 20'000);  // 32 bits of microseconds went round
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), IsEmpty());
  DeviceTime(tap, 10'000);
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre(HasSubstr("counter goes backwards")));
  EXPECT_TRUE(recorder_->Flush());
  EXPECT_EQ(GatherEvidence(folder_ / "record.ulg")->inputs_lost, 1u);
}

TEST_F(BackwardTimeTest, ABoardThatBootsMayStartItsCounterAnew) {
  BusTap tap(*log_);
  DeviceTime(tap, 5'000'000);
  tap.OnFrame(
      {Encode(zro::node::HeartbeatMsg{zro::node::HeartbeatMsg::kNodeId, zro::node::kStateBootUp}),
       clock_.now(), false});
  DeviceTime(tap, 5'000);
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), IsEmpty());
}

TEST_F(BackwardTimeTest, WallTimeThatIsSetBackIsAnAlarmAndNoEntrysAgeIsJudged) {
  BenchLoop loop(bench_, station_, *log_, stop_);
  clock_.AdvanceDate(std::chrono::hours(24));
  ASSERT_TRUE(loop.RunFor(3));
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), IsEmpty());
  clock_.AdvanceDate(-std::chrono::seconds(90));
  ASSERT_TRUE(loop.RunFor(3));
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre(HasSubstr("wall time goes backwards")));
  log_->Write(TableItem{log_->now_us(), 3, 0, board_.ReadTable({})->image});
  zro::node::Frame date = Encode(zro::node::TimeStampMsg{0, 100});
  BusTap(*log_).OnFrame({date, clock_.now(), true});
  End();
  const auto checks = Judged({{"entry_age", {{"at_most_days", 2.0}}, 1}, {"rejects", {}, 2}});
  EXPECT_EQ(checks[0].verdict, Verdict::kRigError);
  EXPECT_THAT(checks[0].reason, HasSubstr("wall time"));
  EXPECT_EQ(checks[1].verdict, Verdict::kFail);  // what hangs on no date is judged as ever
}

TEST_F(BackwardTimeTest, ARecordThatJumpsBackIsTheRigsFault) {
  recorder_->Write(ImuSample{.at_us = 2'000'000, .seq = 1});
  recorder_->Write(ImuSample{.at_us = 1'995'000, .seq = 2});
  End();
  const auto checks = Judged({{"rejects", {}, 1}});  // none: would fail
  EXPECT_EQ(checks[0].verdict, Verdict::kRigError);
  EXPECT_THAT(checks[0].reason, HasSubstr("time goes backwards in the record after 2.000000 s"));
}

}  // namespace
}  // namespace zrobench
