#include "rig/run/bus_tap.h"

#include <gmock/gmock.h>

#include "corrector/node/codec.h"
#include "rig/run/evidence.h"
#include "tests/unit/run/fake_bench.h"

namespace zrobench {
namespace {

using namespace zro::node;
using testing::ElementsAre;
using testing::StartsWith;

class BusTapTest : public BenchTest {
 protected:
  BusTapTest() { BenchTest::SetUp(); }
  void SetUp() override {}
  void See(const Frame& frame, bool own = false) { tap_.OnFrame({frame, clock_.now(), own}); }
  void Raw(std::uint8_t seq) { See(Encode(RawMsg{{100, 0, 0}, seq, 1, false})); }
  void Acc(std::uint8_t seq) { See(Encode(AccMsg{{0, 0, 8000}, seq, false})); }
  void Rate(std::uint8_t seq) {
    RateMsg rate{};
    rate.rate[0] = 256;
    rate.seq = seq;
    See(Encode(rate));
  }
  void Whole(std::uint8_t seq) {
    Raw(seq);
    Acc(seq);
    Rate(seq);
    Pass(0.005);
  }
  void Time(double degc) {
    TimeMsg time{};
    time.temperature = static_cast<std::int16_t>(degc * 256);
    See(Encode(time));
  }
  BusTap tap_{*log_};
};

TEST_F(BusTapTest, ASampleIsWholeWhenItsThreeFramesAreThere) {
  Raw(7);
  Acc(7);
  EXPECT_EQ(Recorded<ImuSample>().size(), 0u);
  Rate(7);
  ASSERT_EQ(Recorded<ImuSample>().size(), 1u);
  EXPECT_EQ(Recorded<ImuSample>()[0].accel[2], 8000);
}

TEST_F(BusTapTest, FramesBetweenTheThreeComeAfterTheSample) {
  Raw(1);
  See(Frame{0x590, 8, {1}});
  Acc(1);
  EXPECT_EQ(Recorded<BusFrame>().size(), 0u);
  Rate(1);
  EXPECT_EQ(Recorded<BusFrame>().size(), 1u);
}

TEST_F(BusTapTest, LostFramesAreCountedSaidOnceASecondAndStayOutOfTheMeans) {
  Time(25);
  std::uint8_t seq = 0;
  for (int i = 0; i < 600; ++i) {
    Raw(seq);
    Acc(seq);
    if (i % 2 == 0) Rate(seq);
    ++seq;
    Pass(0.005);
  }
  tap_.Finish();
  EXPECT_EQ(Recorded<ImuSample>().size(), 600u - 1);  // the last one never ended
  EXPECT_EQ(tap_.incomplete_samples(), 299u);
  const auto alarms = Events(EventItem::Kind::kAlarm);
  EXPECT_LE(alarms.size(), 4u);
  EXPECT_THAT(alarms, testing::Each(StartsWith(std::string(kInputsLost))));
  ASSERT_FALSE(Recorded<MeanItem>().empty());
  EXPECT_FLOAT_EQ(Recorded<MeanItem>()[0].rate_dps[0], 1.0f);  // no zeros averaged in
}

TEST_F(BusTapTest, ASampleCutByThePowerIsNoLossOfTheBus) {
  Whole(1);
  Raw(2);
  See(Encode(HeartbeatMsg{HeartbeatMsg::kNodeId, kStateBootUp}));
  Whole(0);
  EXPECT_EQ(Recorded<ImuSample>().size(), 2u);
  EXPECT_THAT(Events(EventItem::Kind::kAlarm), ElementsAre());
}

TEST_F(BusTapTest, NoMeanBeforeTheTemperatureIsKnown) {
  for (std::uint8_t seq = 0; seq < 220; ++seq) Whole(seq);
  Time(25);
  for (std::uint8_t seq = 220; seq < 250; ++seq) Whole(seq);
  for (std::uint8_t seq = 250; seq != 200; ++seq) Whole(seq);
  ASSERT_FALSE(Recorded<MeanItem>().empty());
  for (const MeanItem& mean : Recorded<MeanItem>()) EXPECT_FLOAT_EQ(mean.imu_degc, 25);
}

}  // namespace
}  // namespace zrobench
