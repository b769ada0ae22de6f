#include "rig/virtual/virtual_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "corrector/node/codec.h"
#include "corrector/node/test_modes.h"

namespace zrobench {
namespace {

using namespace zro::node;

class VirtualRigTest : public testing::Test {
 protected:
  void Start(std::uint64_t seed = 1) {
    clock_ = std::make_unique<VirtualClock>(station_.virtual_rig.epoch);
    auto rig = VirtualRig::Make(station_, seed, *clock_);
    ASSERT_TRUE(rig) << rig.error().message;
    rig_ = std::move(*rig);
  }
  void Run(double seconds) { clock_->Wait(clock_->now() + FromSeconds(seconds), {}); }
  std::vector<Frame> TakeFrames() {
    std::vector<Frame> frames;
    while (const auto frame = rig_->bus().Receive()) frames.push_back(frame->frame);
    return frames;
  }
  template <typename Message>
  static std::vector<Message> Only(const std::vector<Frame>& frames) {
    std::vector<Message> messages;
    for (const Frame& frame : frames) {
      if (Message message; Decode(frame, &message)) messages.push_back(message);
    }
    return messages;
  }
  Instant Soon() const { return clock_->now() + std::chrono::seconds(1); }

  Station station_;
  std::unique_ptr<VirtualClock> clock_;
  std::unique_ptr<VirtualRig> rig_;
};

TEST_F(VirtualRigTest, TheBoardStreamsAtTheStationsRateWithConsecutiveSequence) {
  Start();
  Run(2.05);
  const auto raw = Only<RawMsg>(TakeFrames());
  ASSERT_NEAR(static_cast<double>(raw.size()), 400, 1);
  for (std::size_t i = 1; i < raw.size(); ++i) {
    EXPECT_EQ(raw[i].seq, static_cast<std::uint8_t>(raw[i - 1].seq + 1));
  }
}

TEST_F(VirtualRigTest, RawRateIsTheModelsOffsetAndTheCorrectedOneIsNearZero) {
  Start();
  Run(10);
  const auto frames = TakeFrames();
  double raw_dps = 0, rate_dps = 0;
  const auto raw = Only<RawMsg>(frames);
  const auto rate = Only<RateMsg>(frames);
  const double lsb_dps = station_.virtual_rig.gyro_range_dps / 32768;
  for (const RawMsg& m : raw) raw_dps += m.raw[0] * lsb_dps / static_cast<double>(raw.size());
  for (const RateMsg& m : rate) rate_dps += m.rate[0] / 256.0 / static_cast<double>(rate.size());
  // All at ambient, 23 degC: 0.8 + 0.030 * -2 - 4e-4 * 4 - 1e-5 * 8.
  EXPECT_NEAR(raw_dps, 0.7383, 0.01);
  EXPECT_NEAR(rate_dps, 0, 0.04);  // what three factory entries 15 degC apart allow
}

TEST_F(VirtualRigTest, ThePlateHeatsTheBoardAndStopsWhenMadeSafe) {
  Start();
  ASSERT_TRUE(rig_->plate().SetTarget(45, Soon()));
  Run(600);
  const auto hot = rig_->plate().Read(Soon());
  ASSERT_TRUE(hot);
  EXPECT_NEAR(hot->process_degc, 45, 0.2);
  EXPECT_EQ(hot->setpoint_degc, 45);
  TakeFrames();
  Run(1);
  const auto time = Only<TimeMsg>(TakeFrames());
  ASSERT_FALSE(time.empty());
  EXPECT_NEAR(time.back().temperature / 256.0, 44.7, 0.5);  // droops a little towards ambient
  ASSERT_TRUE(rig_->plate().MakeSafe(Soon()));
  Run(300);
  EXPECT_LT(rig_->plate().Read(Soon())->process_degc, 40);
  EXPECT_EQ(rig_->plate().Read(Soon())->drive_pct, 0);
}

TEST_F(VirtualRigTest, SetPointsBeyondTheStationsLimitsAreRefusedAndChangeNothing) {
  Start();
  const auto refused = rig_->plate().SetTarget(station_.limits.max_degc + 1, Soon());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::kLimit);
  Run(60);
  EXPECT_EQ(rig_->plate().Read(Soon())->drive_pct, 0);
  EXPECT_FALSE(rig_->plate().SetTarget(std::nan(""), Soon()));
}

TEST_F(VirtualRigTest, PowerOffSilencesTheBoardAndPowerOnBootsIt) {
  Start();
  Run(1);
  TakeFrames();
  ASSERT_TRUE(rig_->power().SetOn(false, Soon()));
  Run(2);
  EXPECT_TRUE(TakeFrames().empty());
  ASSERT_TRUE(rig_->power().SetOn(true, Soon()));
  Run(1);
  const auto frames = TakeFrames();
  const auto beats = Only<HeartbeatMsg>(frames);
  ASSERT_FALSE(beats.empty());
  EXPECT_EQ(beats.front().state, kStateBootUp);
  EXPECT_EQ(Only<RawMsg>(frames).front().seq, 0);
}

TEST_F(VirtualRigTest, AToneAtAResonanceShiftsThatAxis) {
  station_.model.terms = {"acoustic.resonance", "acoustic.rectification"};
  Start();
  const auto mean_z = [&] {
    TakeFrames();
    Run(5);
    const auto raw = Only<RawMsg>(TakeFrames());
    double sum = 0;
    for (const RawMsg& m : raw) sum += m.raw[2];
    return sum / static_cast<double>(raw.size()) * station_.virtual_rig.gyro_range_dps / 32768;
  };
  const double silent_dps = mean_z();
  ASSERT_TRUE(rig_->speaker().SetTone(27000, 2, Soon()));
  const double loud_dps = mean_z();
  ASSERT_TRUE(rig_->speaker().Mute(Soon()));
  EXPECT_GT(std::abs(loud_dps - silent_dps), 0.1);
  EXPECT_NEAR(mean_z(), silent_dps, 0.01);
}

TEST_F(VirtualRigTest, AHandShowsInGyroAndAccelerometer) {
  Start();
  ASSERT_TRUE(rig_->hand().StartMove("hand_held", std::chrono::seconds(4)));
  Run(2);
  EXPECT_TRUE(rig_->hand().moving());
  int swings = 0;
  for (const RawMsg& m : Only<RawMsg>(TakeFrames())) swings += std::abs(m.raw[0]) > 1000;
  EXPECT_GT(swings, 50);
  Run(3);
  EXPECT_FALSE(rig_->hand().moving());
  EXPECT_FALSE(rig_->hand().StartMove("dance", std::chrono::seconds(1)));
}

TEST_F(VirtualRigTest, TheSameSeedGivesTheSameFrames) {
  const auto frames_of = [&](std::uint64_t seed) {
    Start(seed);
    Run(3);
    std::vector<std::uint8_t> bytes;
    for (const Frame& f : TakeFrames()) bytes.insert(bytes.end(), f.data, f.data + f.dlc);
    return bytes;
  };
  const auto first = frames_of(7);
  EXPECT_EQ(first, frames_of(7));
  EXPECT_NE(first, frames_of(8));
}

TEST_F(VirtualRigTest, MusicIsPlayedWithinTheStationsLimits) {
  Start();
  EXPECT_TRUE(rig_->speaker().plays_music());
  ASSERT_TRUE(rig_->speaker().SetMusic(24000, 34000, 2, Soon()));
  const auto state = rig_->speaker().Read(Soon());
  ASSERT_TRUE(state);
  EXPECT_EQ(state->hz, 29000);
  EXPECT_EQ(state->band_hz, 10000);
  EXPECT_FALSE(rig_->speaker().SetMusic(24000, 41000, 2, Soon()));
  EXPECT_FALSE(rig_->speaker().SetMusic(10, 24000, 2, Soon()));
  EXPECT_FALSE(rig_->speaker().SetMusic(34000, 24000, 2, Soon()));
  EXPECT_FALSE(rig_->speaker().SetMusic(24000, 34000, 11, Soon()));
  ASSERT_TRUE(rig_->speaker().SetTone(1000, 1, Soon()));
  EXPECT_EQ(rig_->speaker().Read(Soon())->band_hz, 0);
}

TEST_F(VirtualRigTest, TheBoardsOwnLoadWarmsItsDieWhileThePlateHolds) {
  station_.model.terms = {"thermal.self_heating"};
  station_.model.term["thermal.self_heating"]["idle_w"] = {0};
  Start();
  ASSERT_TRUE(rig_->plate().SetTarget(30, Soon()));
  const auto die_degc = [&](double seconds) {
    for (int s = 0; s < seconds; ++s) {
      rig_->bus().Send(Encode(HeartbeatMsg{HeartbeatMsg::kRigId, kStateOperational}));
      TakeFrames();
      Run(1);
    }
    return Only<TimeMsg>(TakeFrames()).back().temperature / 256.0;
  };
  const double idle_degc = die_degc(300);
  const auto write = [&](std::uint8_t sub, std::uint32_t value, int bytes) {
    const auto command = static_cast<std::uint8_t>(0x23 | (4 - bytes) << 2);
    rig_->bus().Send(Encode(SdoMsg{SdoMsg::kRxId, command, 0x2101, sub, value}));
  };
  write(1, TestModes::kKey, 4);
  write(6, 80, 1);
  // 4 W over 0.81 W/K.
  EXPECT_NEAR(die_degc(300) - idle_degc, 0.8 * 5 / 0.81, 0.15);
  EXPECT_NEAR(rig_->plate().Read(Soon())->process_degc, 30, 0.15);
  for (int s = 0; s < 60; ++s) {  // no heartbeat: the load lets go
    TakeFrames();
    Run(1);
  }
  EXPECT_NEAR(Only<TimeMsg>(TakeFrames()).back().temperature / 256.0, idle_degc, 0.15);
}

}  // namespace
}  // namespace zrobench
