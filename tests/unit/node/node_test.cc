#include "corrector/node/node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "corrector/crc32.h"
#include "tests/unit/node/board_fixture.h"

namespace zro::node {
namespace {

using testing::Each;
using testing::ElementsAre;

std::vector<std::uint32_t> IdsFrom(const RecordingSink& sink, std::size_t first) {
  std::vector<std::uint32_t> ids;
  for (std::size_t i = first; i < sink.frames.size(); ++i) ids.push_back(sink.frames[i].id);
  return ids;
}

TEST(Node, BootsUpThenTellsWhoItIs) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 7);
  EXPECT_THAT(IdsFrom(board.sink, 0), ElementsAre(0x710, 0x6B0, 0x6B0, 0x6B0, 0x6B0));
  EXPECT_EQ(board.sink.frames[0].data[0], kStateBootUp);
  const std::vector<IdentMsg> pages = board.sink.All<IdentMsg>();
  EXPECT_EQ(pages[0].fw_minor, 12);
  EXPECT_EQ(pages[0].build_id, 0xCAFEF00Du);
  EXPECT_EQ(pages[1].hw_rev, 4);
  EXPECT_EQ(pages[1].serial, 0x12345u);
  std::uint8_t image[Table::kMaxImageBytes];
  const std::size_t size = Table().ToImage(0, image);
  EXPECT_EQ(pages[2].lut_points, 0);
  EXPECT_EQ(pages[2].lut_crc32, Crc32(image, size));
  EXPECT_EQ(board.node.nmt_state(), kStateOperational);
}

TEST(Node, FramesOfASampleInOrder) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 0);
  for (int n = 0; n < 25; ++n) {
    const std::size_t before = board.sink.frames.size();
    board.Run(1);
    const bool with_time = n % 10 == 0;
    const std::vector<std::uint32_t> ids = IdsFrom(board.sink, before);
    if (with_time) {
      EXPECT_THAT(ids, ElementsAre(0x390, 0x290, 0x2D0, 0x190, 0x490)) << n;
    } else {
      EXPECT_THAT(ids, ElementsAre(0x290, 0x2D0, 0x190)) << n;
    }
  }
}

TEST(Node, TimeNamesTheSampleThatFollows) {
  Board board;
  board.counter = 0xFFF0;
  board.node.Boot(BootReason::kPowerOn, 0);
  board.Run(40);
  std::uint32_t expected_us = 0;
  for (std::size_t i = 0; i < board.sink.frames.size(); ++i) {
    TimeMsg time{};
    if (!Decode(board.sink.frames[i], &time)) continue;
    RawMsg raw{};
    ASSERT_TRUE(Decode(board.sink.frames[i + 1], &raw));
    EXPECT_EQ(raw.seq, time.sample_seq & 0xFF);
    EXPECT_EQ(time.sample_time_us, expected_us) << "counter wraps at 16 bits, device time does not";
    expected_us += 50'000;
  }
  EXPECT_EQ(expected_us, 200'000u);
}

TEST(Node, CorrectorSeesTheTemperatureOfTheLastDutTime) {
  // Two boards, the second with wild temperatures wherever the bus does not show them.
  Board plain, wild;
  plain.node.Boot(BootReason::kPowerOn, 0);
  wild.node.Boot(BootReason::kPowerOn, 0);
  for (int n = 0; n < 4000; ++n) {
    plain.temperature = wild.temperature = static_cast<std::int16_t>(20 * 256 + n / 100);
    plain.node.OnSample(plain.Next());
    RawSample raw = wild.Next();
    if (n % 10 != 0) raw.temperature = 32000;
    wild.node.OnSample(raw);
  }
  ASSERT_EQ(plain.sink.frames.size(), wild.sink.frames.size());
  for (std::size_t i = 0; i < plain.sink.frames.size(); ++i) {
    ASSERT_EQ(std::memcmp(plain.sink.frames[i].data, wild.sink.frames[i].data, 8), 0) << i;
  }
  EXPECT_GT(plain.node.log().total(), 0u) << "the comparison must cover decisions";
}

TEST(Node, OnTimeNeverChangesWhatTheCorrectorDoes) {
  Board with, without;
  with.node.Boot(BootReason::kPowerOn, 0);
  without.node.Boot(BootReason::kPowerOn, 0);
  for (int n = 0; n < 3000; ++n) {
    with.Run(1);
    with.node.OnTime(static_cast<std::uint32_t>(n) * 5);
    without.Run(1);
  }
  EXPECT_EQ(with.sink.All<RateMsg>().size(), 3000u);
  std::uint8_t a[Table::kMaxImageBytes], b[Table::kMaxImageBytes];
  const std::size_t size = with.node.corrector().table().ToImage(0, a);
  ASSERT_EQ(without.node.corrector().table().ToImage(0, b), size);
  EXPECT_EQ(std::memcmp(a, b, size), 0);
  EXPECT_EQ(with.node.log().total(), without.node.log().total());
}

TEST(Node, RateIsRawMinusWhatDutCorrStates) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 0);
  board.Write(0x2101, 1, TestModes::kKey, 4);
  board.node.OnFrame(Frame{0x610, 8, {0x21, 0x05, 0x20, 0, 20}});
  std::uint8_t entry[21] = {};
  const float values[] = {20.0f, 1.5f, -0.75f, 0.25f, 0.001f};
  std::memcpy(entry, values, 20);
  for (int i = 0; i < 3; ++i) {
    Frame segment{0x610, 8, {static_cast<std::uint8_t>(i % 2 << 4 | (i == 2 ? 3 : 0))}};
    std::memcpy(segment.data + 1, entry + 7 * i, 7);
    board.node.OnFrame(segment);
  }
  ASSERT_EQ(board.node.corrector().table().size(), 1);
  board.Run(1);
  const CorrMsg corr = board.sink.All<CorrMsg>().at(0);
  EXPECT_EQ(corr.corr[0], 1536);
  EXPECT_EQ(corr.corr[1], -768);
  EXPECT_EQ(corr.corr[2], 256);
  const RawMsg raw = board.sink.All<RawMsg>().at(0);
  const RateMsg rate = board.sink.All<RateMsg>().at(0);
  const float raw_dps = static_cast<float>(raw.raw[0]) * 250.0f / 32768.0f;
  EXPECT_NEAR(rate.rate[0] / 256.0f, raw_dps - 1.5f, 1.0f / 512);
  EXPECT_TRUE(rate.corr_applied);
}

TEST(Node, CorruptStoreIsAnEmergencyAtBoot) {
  RamStorage storage;
  Board first(&storage);
  first.node.Boot(BootReason::kPowerOn, 1);
  ASSERT_EQ(first.Write(0x1010, 1, kSaveSignature, 4).cmd, 0x60);
  for (auto& slot : storage.slots) {
    for (std::size_t i = 0; i < slot.size(); i += 3) slot[i] ^= 0x5A;
  }
  Board board(&storage);
  board.node.Boot(BootReason::kPowerOn, 2);
  const std::vector<EmcyMsg> emcy = board.sink.All<EmcyMsg>();
  ASSERT_EQ(emcy.size(), 1u);
  EXPECT_EQ(emcy[0].code, 0xFF10 + 13);
  EXPECT_EQ(emcy[0].reason, 13);
  EXPECT_EQ(emcy[0].axis, kNoAxis);
  EXPECT_EQ(emcy[0].measured, 0);
  EXPECT_EQ(emcy[0].error_register, 0x81);
  EXPECT_EQ(emcy[0].event_seq, board.node.log().newest() & 0xFF);
  EXPECT_EQ(board.Read(0x1001, 0).data & 0xFF, 0x81u);
  EXPECT_EQ(board.Read(0x1003, 1).data & 0xFFFF, 0xFF1Du);
  EXPECT_EQ(board.Write(0x1003, 0, 0, 1).cmd, 0x60);
  EXPECT_EQ(board.Read(0x1001, 0).data & 0xFF, 0u);
  EXPECT_EQ(board.Read(0x1003, 1).data, static_cast<std::uint32_t>(SdoAbort::kNoContent));
}

TEST(Node, EveryRejectionIsAnEmergencyAndEveryEventIsLogged) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 0);
  for (int cycle = 0; cycle < 6; ++cycle) {
    board.Run(700);  // still, but not for long enough ...
    for (int n = 0; n < 40; ++n) {
      RawSample moved = board.Next();
      moved.accel[0] = static_cast<std::int16_t>(n % 2 ? 3000 : -3000);
      board.node.OnSample(moved);
    }
  }
  board.Run(4000);  // ... and now it is
  const std::vector<EmcyMsg> emcy = board.sink.All<EmcyMsg>();
  EXPECT_GE(emcy.size(), 3u);
  std::uint8_t records[EventLog::kMaxRead * kLogRecordBytes];
  const std::uint32_t n = board.node.log().Peek(records);
  std::size_t rejections = 0;
  bool wrote = false;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint8_t* record = records + i * kLogRecordBytes;
    const auto code = static_cast<Code>(record[10]);
    wrote = wrote || code == Code::kNew;
    if (!IsRejection(code)) continue;
    ASSERT_LT(rejections, emcy.size());
    EXPECT_EQ(emcy[rejections].reason, record[10]);
    EXPECT_EQ(emcy[rejections].event_seq, record[0]);
    EXPECT_EQ(emcy[rejections].code, 0xFF10 + record[10]);
    ++rejections;
  }
  EXPECT_TRUE(wrote);
  EXPECT_EQ(rejections, emcy.size());
}

TEST(Node, DateOfNewEntriesIsTheTimeStamps) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 0);
  board.node.OnFrame(Encode(TimeStampMsg{12'345, 15'000}));
  board.Run(6000);
  ASSERT_GE(board.node.corrector().table().size(), 1);
  EXPECT_EQ(board.node.corrector().table()[0].date, 15'000);
}

TEST(Node, WhatADateDecidesIsLoggedAtOnce) {
  Config config = ConfigFor(200.0f, 0.005f);
  config.coverage_min_degc = 20.0f;
  config.coverage_max_degc = 22.5f;
  Board board(nullptr, config);
  board.node.Boot(BootReason::kPowerOn, 0);
  board.node.OnFrame(Encode(TimeStampMsg{0, 15'000}));
  board.temperature = 21 * 256;
  board.Run(1400);
  ASSERT_TRUE(board.node.corrector().complete());
  const std::uint32_t before = board.node.log().total();
  board.node.OnFrame(Encode(TimeStampMsg{0, 15'100}));  // the entry is old now: re-armed
  EXPECT_EQ(board.node.log().total(), before + 1);
}

TEST(Node, PeriodicFramesKeepTheirPeriods) {
  Board board;
  board.node.Boot(BootReason::kWatchdog, 9);
  board.sink.frames.clear();
  for (std::uint32_t ms = 0; ms <= 10'000; ++ms) board.node.OnTime(ms);
  const std::vector<HeartbeatMsg> beats = board.sink.All<HeartbeatMsg>();
  EXPECT_EQ(beats.size(), 20u);
  EXPECT_EQ(beats[0].state, kStateOperational);
  EXPECT_EQ(board.sink.All<IdentMsg>().size(), 4u);
  const std::vector<StatusMsg> status = board.sink.All<StatusMsg>();
  ASSERT_EQ(status.size(), 10u);
  EXPECT_EQ(status[9].uptime_s, 10u);
  EXPECT_EQ(status[9].boot_count, 9);
  EXPECT_EQ(status[9].boot_reason, 4);
  EXPECT_EQ(status[9].corr_mode, 2);
  EXPECT_FALSE(status[9].rig_heartbeat_ok);
}

TEST(Node, RigHeartbeatIsGoodForAShortTime) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 0);
  board.node.OnTime(900);
  board.node.OnFrame(Encode(HeartbeatMsg{HeartbeatMsg::kRigId, kStateOperational}));
  board.node.OnTime(2000);
  board.node.OnTime(3000);
  const std::vector<StatusMsg> status = board.sink.All<StatusMsg>();
  ASSERT_EQ(status.size(), 2u);
  EXPECT_TRUE(status[0].rig_heartbeat_ok);
  EXPECT_FALSE(status[1].rig_heartbeat_ok);
}

TEST(Node, NetworkManagement) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 0);
  const auto nmt = [&board](std::uint8_t command, std::uint8_t node) {
    board.node.OnFrame(Encode(NmtMsg{command, node}));
    board.sink.frames.clear();
  };
  nmt(kNmtStop, 0x11);  // somebody else
  board.Run(1);
  EXPECT_FALSE(board.sink.frames.empty());
  nmt(kNmtStop, Node::kNodeId);
  board.Run(1);
  EXPECT_EQ(board.Read(0x1000, 0).cmd, 0) << "no SDO when stopped";
  EXPECT_TRUE(board.sink.frames.empty());
  nmt(kNmtEnterPreOp, 0);
  board.Run(1);
  EXPECT_EQ(board.Read(0x1000, 0).cmd, 0x43);
  EXPECT_TRUE(board.sink.All<RawMsg>().empty());
  nmt(kNmtStart, 0);
  board.Run(1);
  EXPECT_THAT(IdsFrom(board.sink, 0), ElementsAre(0x390, 0x290, 0x2D0, 0x190, 0x490));
  EXPECT_FALSE(board.node.reset_requested());
  nmt(kNmtResetNode, Node::kNodeId);
  EXPECT_TRUE(board.node.reset_requested());
  board.Run(1);
  board.node.OnTime(100'000);
  EXPECT_TRUE(board.sink.frames.empty()) << "this life is over";
}

}  // namespace
}  // namespace zro::node
