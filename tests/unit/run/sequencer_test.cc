// How a run ends, whatever happens to it: by what, and with which bench.
#include "rig/run/sequencer.h"

#include <gmock/gmock.h>

#include <csignal>
#include <tuple>

#include "rig/run/run.h"
#include "tests/unit/run/fake_bench.h"

namespace zrobench {
namespace {

using Why = Halt::Why;
using testing::ElementsAre;
using testing::HasSubstr;

class SequencerTest : public BenchTest {
 protected:
  Flow Execute(std::vector<Step> steps) {
    profile_.steps = std::move(steps);
    BenchLoop loop(bench_, station_, *log_, stop_);
    return Sequencer(profile_, loop).Execute();
  }
  void ExpectSafe() {
    EXPECT_FALSE(plate_.on);
    EXPECT_EQ(speaker_.v, 0);
    EXPECT_TRUE(power_.on);
    ASSERT_FALSE(Events(EventItem::Kind::kRunEnd).empty());
  }
  Profile profile_;
};

const Tone kTone{1000, 1, 94, 5};

TEST_F(SequencerTest, AWholeProfileCompletesAndLeavesTheBenchSafe) {
  const Flow flow = Execute({{Ramp{25, 10}, {}, 1}, {kTone, {}, 2}, {PowerCycle{3}, {}, 3}});
  ASSERT_TRUE(flow) << flow.error().text;
  ExpectSafe();
  EXPECT_THAT(Events(EventItem::Kind::kRunEnd), ElementsAre("completed"));
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre());
  EXPECT_EQ(board_.dates, 2);  // after the first reset and after the power cut
}

TEST_F(SequencerTest, TheDateIsMovedAndTheBoardIsTold) {
  bench_.advance_date = [this](Duration by) { clock_.AdvanceDate(by); };
  const UtcNs before = clock_.utc();
  const Flow flow = Execute({{DateStep{40}, {}, 1}});
  ASSERT_TRUE(flow) << flow.error().text;
  EXPECT_NEAR(static_cast<double>(clock_.utc() - before) / 86400e9, 40, 0.001);
  EXPECT_EQ(board_.dates, 2);
}

TEST_F(SequencerTest, ABenchOfRealTimeRefusesToMoveTheDate) {
  const Flow flow = Execute({{DateStep{40}, {}, 1}});
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kRigFault);
  EXPECT_THAT(flow.error().text, HasSubstr("cannot move the date"));
  ExpectSafe();
}

TEST_F(SequencerTest, AFirstRampStartsWhereThePlateIs) {
  plate_.degc = plate_.target_degc = 40;
  ASSERT_TRUE(Execute({{Ramp{38, 60}, {}, 1}}));
  for (const PlateItem& item : Recorded<PlateItem>()) EXPECT_GE(item.setpoint_degc, 38);
}

TEST_F(SequencerTest, ABugIsCaughtAndTheBenchIsMadeSafe) {
  speaker_.throws = true;
  const Flow flow = Execute({{Ramp{25, 10}, {}, 1}, {kTone, {}, 2}});
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kInternal);
  EXPECT_EQ(ExitCode({}, flow, 0), 70);
  ExpectSafe();
}

TEST_F(SequencerTest, APlateThatDoesNotAnswerIsTheRigsFault) {
  plate_.broken = true;
  const Flow flow = Execute({{Hold{5}, {}, 1}});
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kRigFault);
  EXPECT_THAT(flow.error().text, HasSubstr("no answer"));
  ExpectSafe();
}

TEST_F(SequencerTest, ASilentBoardIsTheRigsFaultWithinThreeSeconds) {
  board_.silent = true;
  const Flow flow = Execute({{Hold{500}, {}, 1}});
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kRigFault);
  EXPECT_LT(SecondsOf(clock_.now()), 7);
}

TEST_F(SequencerTest, AFarTooHotPlateTrips) {
  plate_.degc = station_.limits.max_degc + 11;
  const Flow flow = Execute({{Hold{5}, {}, 1}});
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kSafetyTrip);
  ExpectSafe();
}

TEST_F(SequencerTest, ASetPointBelowTheDewPointOfTheAirIsRefused) {
  station_.humidity_pct = 90;
  const Flow flow = Execute({{Soak{18, 1, 0.3}, {}, 1}});
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kSafetyTrip);
  station_.purge = true;
  EXPECT_TRUE(Execute({{Soak{18, 1, 0.3}, {}, 1}}));
}

TEST_F(SequencerTest, ABenchThatCannotBeMadeSafeIsNeverASuccess) {
  plate_.cannot_stop = true;
  for (const int level : {0, 2}) {
    stop_.level = level;
    const Flow flow = Execute({{Hold{1}, {}, 1}});
    ASSERT_FALSE(flow);
    EXPECT_EQ(flow.error().why, Why::kRigFault);
    EXPECT_EQ(ExitCode({}, flow, SIGINT), 3);
    EXPECT_THAT(flow.error().text, HasSubstr("could not be made safe"));
  }
}

TEST_F(SequencerTest, ABoardThatRebootsByItselfRaisesAnAlarm) {
  BenchLoop loop(bench_, station_, *log_, stop_);
  loop.ExpectBoot(false);
  ASSERT_TRUE(loop.RunFor(3));
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre());
  board_.Boot();
  ASSERT_TRUE(loop.RunFor(3));
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre(HasSubstr("rebooted on its own")));
}

TEST_F(SequencerTest, OnlyATableThatOutlivedABootIsRecordedAsTheStart) {
  board_.forget_at_boots = 1;  // what it holds now is not what it boots with
  ASSERT_TRUE(Execute({{Hold{1}, {}, 1}}));
  std::uint32_t generation = 0;
  zro::Table table;
  const TableItem first = Recorded<TableItem>().front();
  ASSERT_TRUE(table.FromImage(first.image.data(), first.image.size(), &generation));
  EXPECT_EQ(first.when, 0);
  EXPECT_EQ(generation, 2u);
}

TEST_F(SequencerTest, ATableThatNeverComesToRestMakesInputsLost) {
  board_.forget_at_boots = 99;
  ASSERT_TRUE(Execute({{Hold{1}, {}, 1}}));
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre(HasSubstr("inputs lost: ")));
}

TEST_F(SequencerTest, AStimulusThatNeverBeganIsAnAlarm) {
  ASSERT_TRUE(Execute({{Hold{2}, {{kTone, 9.0, {}}}, 1}}));
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre(HasSubstr("never began")));
}

/// Asks for a stop at a moment of bench time.
class Interrupter final : public Simulation {
 public:
  Interrupter(StopRequest& stop, double at_s, int level)
      : stop_(stop), at_(FromSeconds(at_s)), level_(level) {}
  Instant next_event() const override { return done_ ? Instant::max() : at_; }
  void Run(Instant) override {
    stop_.level = level_;
    done_ = true;
  }

 private:
  StopRequest& stop_;
  Instant at_;
  int level_;
  bool done_ = false;
};

TEST_F(SequencerTest, OneRequestLetsAToneEndTwoDoNot) {
  for (const auto& [level, at_least_s, at_most_s] :
       {std::tuple{1, 4.9, 5.3}, std::tuple{2, 0.5, 1.3}}) {
    const double from_s = SecondsOf(clock_.now());
    stop_.level = 0;
    Interrupter interrupter(stop_, from_s + 1, level);
    clock_.Attach(&interrupter);
    const Flow flow = Execute({{kTone, {}, 1}, {Hold{500}, {}, 2}});
    clock_.Attach(nullptr);
    ASSERT_FALSE(flow);
    EXPECT_EQ(flow.error().why, Why::kInterrupted);
    EXPECT_GT(SecondsOf(clock_.now()) - from_s, at_least_s);
    EXPECT_LT(SecondsOf(clock_.now()) - from_s, at_most_s);
    ExpectSafe();
  }
}

TEST_F(SequencerTest, AnInterruptWhileTheBoardIsOffLeavesItOn) {
  Interrupter interrupter(stop_, 2, 2);
  clock_.Attach(&interrupter);
  const Flow flow = Execute({{PowerCycle{60}, {}, 1}});
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kInterrupted);
  EXPECT_LT(SecondsOf(clock_.now()), 5);
  ExpectSafe();
}

TEST_F(SequencerTest, SoundsAndLoadsAreStepsToo) {
  const Flow flow = Execute({{Music{24000, 34000, 4, 106, 5}, {}, 1},
                             {Sweep{100, 300, 100, 1, 94, 1, 3}, {}, 2},
                             {Load{60, 7}, {}, 3}});
  ASSERT_TRUE(flow) << flow.error().text;
  EXPECT_THAT(Events(EventItem::Kind::kStepBegin),
              ElementsAre("music 24000 to 34000 Hz 106 dB SPL for 5 s",
                          "sweep 100 to 300 Hz 94 dB SPL, 3 tones for 3 s", "load 60 % for 7 s"));
  EXPECT_NEAR(SecondsOf(clock_.now()), 15, 1.5);
  EXPECT_EQ(board_.load_pct, 0);
  ExpectSafe();
}

TEST_F(SequencerTest, ABoardWithoutALoadSkipsAProfileThatNeedsOneBeforeAnythingMoves) {
  board_.loads = false;
  for (const Step& load : {Step{Load{60, 7}, {}, 2}, Step{Hold{9}, {{Load{60, 7}, 1.0, {}}}, 2}}) {
    const Flow flow = Execute({{Soak{40, 10, 0.3}, {}, 1}, load});
    ASSERT_FALSE(flow);
    EXPECT_EQ(flow.error().why, Why::kUnfit);
    EXPECT_THAT(flow.error().text, HasSubstr("cannot load itself (object 0x2101:6"));
    EXPECT_EQ(ExitCode({}, flow, 0), 4);
    EXPECT_THAT(Events(EventItem::Kind::kStepBegin), ElementsAre());
    ExpectSafe();
  }
  EXPECT_TRUE(Execute({{Hold{1}, {}, 1}}));
}

TEST_F(SequencerTest, OneRequestDoesNotWaitForALoad) {
  Interrupter interrupter(stop_, 4, 1);
  clock_.Attach(&interrupter);
  const Flow flow = Execute({{Load{60, 500}, {}, 1}});
  clock_.Attach(nullptr);
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().why, Why::kInterrupted);
  EXPECT_LT(SecondsOf(clock_.now()), 6);
  EXPECT_EQ(board_.load_pct, 0);
}

TEST(ExitCode, TheFirstThatAppliesWins) {
  const auto check = [](Verdict verdict) {
    return std::vector<CheckResult>{
        {.check = "a", .about = {}, .verdict = verdict, .reason = {}, .measurements = {}}};
  };
  EXPECT_EQ(ExitCode(check(Verdict::kPass), {}, 0), 0);
  EXPECT_EQ(ExitCode(check(Verdict::kMarginal), {}, 0), 0);
  EXPECT_EQ(ExitCode(check(Verdict::kFail), {}, 0), 1);
  EXPECT_EQ(ExitCode(check(Verdict::kRigError), {}, 0), 3);
  EXPECT_EQ(ExitCode(check(Verdict::kInconclusive), {}, 0), 4);
  EXPECT_EQ(ExitCode({}, {}, 0), 4);
  EXPECT_EQ(ExitCode(check(Verdict::kFail), Stop(Why::kSafetyTrip, ""), 0), 6);
  EXPECT_EQ(ExitCode(check(Verdict::kFail), Stop(Why::kRigFault, ""), 0), 3);
  EXPECT_EQ(ExitCode(check(Verdict::kFail), Stop(Why::kInterrupted, ""), SIGTERM), 143);
  EXPECT_EQ(ExitCode(check(Verdict::kFail), Stop(Why::kInterrupted, ""), 0), 130);
}

}  // namespace
}  // namespace zrobench
