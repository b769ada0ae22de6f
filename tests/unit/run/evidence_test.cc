// Records made by hand: what the checks get to see of them.
#include "rig/run/evidence.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "corrector/node/codec.h"
#include "corrector/node/event_log.h"
#include "tests/unit/run/fake_bench.h"

namespace zrobench {
namespace {

using Kind = EventItem::Kind;

constexpr std::uint64_t kS = 1'000'000;

class EvidenceTest : public BenchTest {
 protected:
  EvidenceTest() { BenchTest::SetUp(); }
  void SetUp() override {}

  void Event(double at_s, Kind kind, const std::string& text = "", double a = 0) {
    recorder_->Write(EventItem{.at_us = Us(at_s), .kind = kind, .a = a, .text = text});
  }
  void Decision(double read_at_s, std::uint32_t seq, std::uint32_t device_us,
                bool damaged = false) {
    zro::Event event{};
    event.seq = seq;
    event.code = zro::Code::kNew;
    LogItem item{Us(read_at_s), {}};
    zro::node::PackLogRecord(event, device_us, item.bytes.data());
    if (damaged) item.bytes[9] ^= 0x40;
    recorder_->Write(item);
  }
  void Frame(double at_s, const zro::node::Frame& frame) {
    BusFrame item{Us(at_s), frame.id, frame.dlc, 0, {}};
    std::copy_n(frame.data, 8, item.data.begin());
    recorder_->Write(item);
  }
  void Boot(double at_s) {
    using zro::node::HeartbeatMsg;
    Frame(at_s, Encode(HeartbeatMsg{HeartbeatMsg::kNodeId, zro::node::kStateBootUp}));
  }
  void Sample(double at_s, std::uint8_t seq) {
    recorder_->Write(ImuSample{.at_us = Us(at_s), .seq = seq});
  }
  void Time(double at_s, std::uint32_t device_us) {
    recorder_->Write(ImuTime{Us(at_s), device_us, 0, 0});
  }
  Evidence Gather() {
    EXPECT_TRUE(recorder_->Flush());
    auto evidence = GatherEvidence(folder_ / "record.ulg");
    EXPECT_TRUE(evidence);
    return *evidence;
  }
  static std::uint64_t Us(double s) { return static_cast<std::uint64_t>(s * 1e6); }
};

TEST_F(EvidenceTest, ADecisionIsTimedByTheNewestPairOfClocksAlsoAfterTheDevicesClockWraps) {
  Time(10, 4'294'000'000u);  // 0.967 s before the wrap
  Decision(11, 1, 4'293'000'000u);
  Time(12, 1'032'704u);
  Decision(13, 2, 4'294'800'000u);  // still before the wrap: 1.2 s ago
  const Evidence evidence = Gather();
  ASSERT_EQ(evidence.decisions.size(), 2u);
  EXPECT_NEAR(static_cast<double>(evidence.decisions[0].at_us), 9e6, 10);
  EXPECT_NEAR(static_cast<double>(evidence.decisions[1].at_us), 10.8e6, 10);
}

TEST_F(EvidenceTest, ABootStartsSequencesAndClocksAnew) {
  Time(1, 50 * kS);
  Sample(1, 100);
  Decision(2, 40, 49 * kS);
  Boot(5);
  Time(5.05, 0);
  Sample(5.05, 0);
  Decision(8, 0, 1 * kS);
  const Evidence evidence = Gather();
  EXPECT_EQ(evidence.samples_lost, 0u);
  EXPECT_EQ(evidence.decisions_lost, 0u);
  EXPECT_NEAR(static_cast<double>(evidence.decisions[1].at_us), 6.05e6, 10);
}

TEST_F(EvidenceTest, MissingSamplesAndDecisionsAreCounted) {
  Sample(1, 254);
  Sample(1.1, 1);  // 255 and 0 are gone
  Decision(2, 5, 0);
  Decision(2, 8, 0);
  Decision(2, 9, 0, true);
  Decision(2, 10, 0);
  const Evidence evidence = Gather();
  EXPECT_EQ(evidence.samples_lost, 2u);
  EXPECT_EQ(evidence.decisions_lost, 3u);
}

TEST_F(EvidenceTest, OverlappingStimuliKeepTheirOwnEnds) {
  Event(10, Kind::kStimulusBegin, "tone");
  Event(12, Kind::kStimulusBegin, "move tap");
  Event(15, Kind::kStimulusEnd, "move tap");
  Event(20, Kind::kStimulusEnd, "tone");
  const Evidence evidence = Gather();
  ASSERT_EQ(evidence.stimuli.size(), 2u);
  EXPECT_EQ(evidence.stimuli[0].last_us, 20 * kS);
  EXPECT_EQ(evidence.stimuli[1].last_us, 15 * kS);
  EXPECT_TRUE(evidence.stimuli[1].Is("tap"));
  EXPECT_TRUE(evidence.stimuli[1].Is("move"));
  EXPECT_FALSE(evidence.stimuli[1].Is("tone"));
}

TEST_F(EvidenceTest, AStimulusLeftOpenLastsToTheEnd) {
  Event(10, Kind::kStimulusBegin, "tone");
  Sample(30, 0);
  EXPECT_EQ(Gather().stimuli[0].last_us, 30 * kS);
}

TEST_F(EvidenceTest, SecondsInAndJustAfterAStimulusAreNotQuiet) {
  Event(10, Kind::kStimulusBegin, "tone");
  Event(12, Kind::kStimulusEnd, "tone");
  for (std::uint64_t s = 9; s <= 17; ++s) recorder_->Write(MeanItem{.at_us = s * kS});
  std::vector<std::uint64_t> quiet;
  for (const Second& second : Gather().seconds) {
    if (second.quiet) quiet.push_back(second.mean.at_us / kS);
  }
  EXPECT_THAT(quiet, testing::ElementsAre(9, 10, 15, 16, 17));
}

TEST_F(EvidenceTest, EveryPowerCutHasItsOwnStateOfTheStore) {
  zro::node::StatusMsg status{};
  status.nv_state = 1;
  Frame(1, Encode(status));
  Event(2, Kind::kPower, "", 0);
  Event(3, Kind::kPower, "", 1);
  status.nv_state = 0;
  Frame(4, Encode(status));
  Event(5, Kind::kPower, "", 0);
  const Evidence evidence = Gather();
  ASSERT_EQ(evidence.cuts.size(), 2u);
  EXPECT_FALSE(evidence.cuts[0].clean);
  EXPECT_TRUE(evidence.cuts[1].clean);
  EXPECT_EQ(evidence.stimuli[0].last_us, 3 * kS);
}

TEST_F(EvidenceTest, AlarmsAreKeptAndLostInputsCounted) {
  Event(1, Kind::kAlarm, "the door is open");
  Event(2, Kind::kAlarm, fmt::format("{}3 samples", kInputsLost));
  const Evidence evidence = Gather();
  EXPECT_EQ(evidence.alarms.size(), 2u);
  EXPECT_EQ(evidence.inputs_lost, 1u);
  EXPECT_FALSE(evidence.completed);
}

TEST_F(EvidenceTest, SecondsOfAnotherAgeAreToldApart) {
  const auto date = [&](double at_s, std::uint16_t days) {
    Frame(at_s, Encode(zro::node::TimeStampMsg{0, days}));
  };
  date(0.5, 100);
  for (int s = 1; s <= 30; ++s) {
    recorder_->Write(MeanItem{.at_us = Us(s)});
    if (s == 5) date(5.5, 101);  // midnight: no age to speak of
    if (s == 10) date(10.5, 160);
    if (s == 20) date(20.5, 230);
  }
  const Evidence evidence = Gather();
  EXPECT_EQ(evidence.today_days, 230);
  const auto from_to = [&](double at_s) {
    const auto seconds = SameAge(evidence, Us(at_s));
    return std::pair(seconds.front().mean.at_us / kS, seconds.back().mean.at_us / kS);
  };
  EXPECT_EQ(from_to(3), std::pair(std::uint64_t{1}, std::uint64_t{10}));
  // The second in which it moved belongs to neither.
  EXPECT_EQ(from_to(15), std::pair(std::uint64_t{12}, std::uint64_t{20}));
  EXPECT_EQ(from_to(30), std::pair(std::uint64_t{22}, std::uint64_t{30}));
}

}  // namespace
}  // namespace zrobench
