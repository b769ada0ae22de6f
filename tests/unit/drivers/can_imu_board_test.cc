// The board's driver against the board's own node, over the in-memory bus and in virtual time.
#include "drivers/imu/can_imu_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corrector/bytes.h"
#include "corrector/crc32.h"
#include "corrector/node/event_log.h"
#include "tests/unit/drivers/node_world.h"

namespace zrobench {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

class Tap final : public FrameListener {
 public:
  void OnFrame(const CanFrame& frame) override { frames.push_back(frame); }
  std::vector<CanFrame> frames;
};

class CanImuBoardTest : public testing::Test {
 protected:
  Instant In(Duration d) const { return clock_.now() + d; }
  void Let(Duration pass) {
    const Instant end = In(pass);
    while (clock_.now() < end) {
      clock_.Wait(std::min(end, In(10ms)), {});
      ASSERT_TRUE(board_.Pump());
    }
  }
  Status Factory(double temp_degc, double x_dps) {
    return board_.DownloadFactoryEntry(temp_degc, {x_dps, -1.0, 0.5}, 0.002, In(1s));
  }

  VirtualClock clock_{1'767'225'600'000'000'000};  // 2026-01-01
  NodeWorld world_{&clock_};
  Tap tap_;
  CanImuBoard board_{world_.bus, clock_, &tap_};
};

TEST_F(CanImuBoardTest, TableComesBackAsItWasDownloaded) {
  for (double t : {10.0, 25.0, 40.0}) ASSERT_TRUE(Factory(t, 0.01 * t));
  ASSERT_TRUE(board_.StoreTable(In(1s)));
  const Result<TableSnapshot> snapshot = board_.ReadTable(In(1s));
  ASSERT_TRUE(snapshot) << snapshot.error().message;
  ASSERT_EQ(snapshot->table.size(), 3);
  EXPECT_FLOAT_EQ(snapshot->table[1].temp_degc, 25.0f);
  EXPECT_FLOAT_EQ(snapshot->table[1].zro_dps[0], 0.25f);
  EXPECT_FLOAT_EQ(snapshot->table[2].sigma_dps, 0.002f);
  EXPECT_EQ(snapshot->table[0].origin, zro::Origin::kFactory);
  EXPECT_EQ(snapshot->generation, world_.node->corrector().generation());
  EXPECT_EQ(snapshot->crc32, zro::Crc32(snapshot->image.data(), snapshot->image.size()));
  const auto frozen = board_.sdo().Upload(0x2004, 1, In(1s));
  ASSERT_TRUE(frozen);
  EXPECT_EQ(frozen->at(0), 0) << "released";
}

TEST_F(CanImuBoardTest, BoardIsLockedBeforeAndAfterADownload) {
  const std::uint8_t entry[20] = {};
  const Status refused = board_.sdo().Download(0x2005, 0, entry, In(1s));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::kRefused);
  EXPECT_THAT(refused.error().message, HasSubstr("08000022"));
  ASSERT_TRUE(Factory(20, 0.1));
  EXPECT_FALSE(board_.sdo().Download(0x2005, 0, entry, In(1s)));
  EXPECT_EQ(world_.node->corrector().table().size(), 1);
}

TEST_F(CanImuBoardTest, ImpossibleFactoryEntryIsRefusedAndTheBoardLocked) {
  const Status status = Factory(std::nan(""), 0.1);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, Error::Kind::kRefused);
  EXPECT_EQ(zro::GetU32(board_.sdo().Upload(0x2101, 1, In(1s))->data()), 0u);
}

TEST_F(CanImuBoardTest, StoredTableSurvivesAPowerCycle) {
  ASSERT_TRUE(Factory(20, 0.1));
  ASSERT_TRUE(board_.StoreTable(In(1s)));
  const std::vector<std::uint8_t> before = board_.ReadTable(In(1s))->image;
  world_.PowerOn();
  EXPECT_EQ(board_.ReadTable(In(1s))->image, before);
}

TEST_F(CanImuBoardTest, RestoreFactoryLeavesTheFactorysEntries) {
  ASSERT_TRUE(board_.DownloadFactoryEntry(40, {0.15, 0.15, 0.15}, 0.01, In(1s)));
  Let(60s);
  ASSERT_GE(world_.node->corrector().table().size(), 2) << "it learned";
  ASSERT_TRUE(board_.RestoreFactory(In(1s)));
  const Result<TableSnapshot> snapshot = board_.ReadTable(In(1s));
  ASSERT_TRUE(snapshot);
  ASSERT_EQ(snapshot->table.size(), 1);
  EXPECT_EQ(snapshot->table[0].origin, zro::Origin::kFactory);
}

TEST_F(CanImuBoardTest, LoadComesAndGoesAndLeavesTheBoardLocked) {
  ASSERT_TRUE(board_.SetLoad(60, In(1s)));
  EXPECT_EQ(world_.node->load_pct(), 60);
  ASSERT_TRUE(board_.SetLoad(0, In(1s)));
  EXPECT_EQ(world_.node->load_pct(), 0);
  EXPECT_EQ(zro::GetU32(board_.sdo().Upload(0x2101, 1, In(1s))->data()), 0u) << "locked";
  const Status absurd = board_.SetLoad(101, In(1s));
  ASSERT_FALSE(absurd);
  EXPECT_EQ(absurd.error().kind, Error::Kind::kRefused);
}

TEST_F(CanImuBoardTest, DateReachesNewEntries) {
  ASSERT_TRUE(board_.SendDate(clock_.utc()));
  Let(60s);
  const zro::Table& table = world_.node->corrector().table();
  ASSERT_GE(table.size(), 1);
  EXPECT_EQ(table[0].date, 15'341) << "2026-01-01, days since 1984-01-01";
}

TEST_F(CanImuBoardTest, TimeStampIsCiaTimeOfDay) {
  ASSERT_TRUE(board_.SendDate(clock_.utc() + 3'600'000'000'000));
  ASSERT_TRUE(board_.Pump());
  zro::node::TimeStampMsg time{};
  ASSERT_TRUE(Decode(tap_.frames.back().frame, &time));
  EXPECT_TRUE(tap_.frames.back().own);
  EXPECT_EQ(time.ms, 3'600'000u);
  EXPECT_EQ(time.days, 15'341);
  EXPECT_EQ(board_.SendDate(441'763'199'000'000'000).error().kind, Error::Kind::kConfig)
      << "1983-12-31T23:59:59";
  EXPECT_TRUE(board_.SendDate(441'763'200'000'000'000));
}

TEST_F(CanImuBoardTest, SilentBoardIsATimeoutAtTheDeadline) {
  world_.silent = true;
  const Instant deadline = In(250ms);
  const Result<TableSnapshot> snapshot = board_.ReadTable(deadline);
  ASSERT_FALSE(snapshot);
  EXPECT_EQ(snapshot.error().kind, Error::Kind::kTimeout);
  EXPECT_EQ(clock_.now(), deadline);
  ASSERT_TRUE(board_.Pump());
  EXPECT_EQ(tap_.frames.back().frame.data[0], 0x80) << "the abort, on the bus";
  world_.silent = false;
  EXPECT_TRUE(board_.ReadTable(In(1s))) << "and all is well when it comes back";
}

TEST_F(CanImuBoardTest, AliveWhileHeard) {
  EXPECT_FALSE(board_.status().alive);
  Let(1s);
  EXPECT_TRUE(board_.status().alive);
  world_.silent = true;
  Let(1400ms);
  EXPECT_TRUE(board_.status().alive);
  Let(200ms);
  EXPECT_FALSE(board_.status().alive);
}

TEST_F(CanImuBoardTest, CountsSamplesBootsAndGaps) {
  Let(2s);
  EXPECT_EQ(board_.status().samples, 400u);
  EXPECT_EQ(board_.status().sequence_gaps, 0u);
  EXPECT_EQ(board_.status().boots_seen, 1u);
  EXPECT_EQ(board_.status().boot_count, 1);
  zro::node::RawMsg raw{};
  raw.seq = static_cast<std::uint8_t>(400 + 4);  // three went missing
  world_.bus.board_sink().Send(Encode(raw));
  ASSERT_TRUE(board_.Pump());
  EXPECT_EQ(board_.status().sequence_gaps, 3u);
  world_.PowerOn();
  Let(2s);
  EXPECT_EQ(board_.status().boots_seen, 2u);
  EXPECT_EQ(board_.status().boot_count, 2);
  EXPECT_EQ(board_.status().sequence_gaps, 3u) << "a boot is no gap";
  EXPECT_EQ(board_.link().lost, 0u);
}

TEST_F(CanImuBoardTest, LogRecordsComeOnceInOrderAndWhole) {
  world_.shaken = true;
  Let(100s);
  const auto first = board_.ReadNewLogRecords(In(2s));
  ASSERT_TRUE(first);
  ASSERT_GT(first->size(), 16u) << "more than one transfer";
  std::uint32_t seq = 0;
  std::uint64_t rejections = 0;
  for (std::size_t i = 0; i < first->size(); ++i) {
    const Result<LogRecord> record = ParseLogRecord(first->at(i));
    ASSERT_TRUE(record);
    if (i > 0) {
      EXPECT_EQ(record->seq, seq + 1);
    }
    seq = record->seq;
    EXPECT_NEAR(record->temp_degc, 20.0, 0.5);
    EXPECT_LE(record->t_us, 100'000'000u);
    rejections += zro::IsRejection(record->code) ? 1 : 0;
  }
  EXPECT_EQ(board_.status().emcy, rejections);
  EXPECT_TRUE(board_.ReadNewLogRecords(In(2s))->empty());
  Let(10s);
  const auto second = board_.ReadNewLogRecords(In(2s));
  ASSERT_FALSE(second->empty());
  EXPECT_EQ(ParseLogRecord(second->front())->seq, seq + 1);
}

TEST_F(CanImuBoardTest, UnreadLogOverflowsAndSaysSo) {
  world_.shaken = true;
  Let(600s);
  const std::uint32_t total = zro::GetU32(board_.sdo().Upload(0x2200, 1, In(1s))->data());
  const std::uint32_t lost = zro::GetU32(board_.sdo().Upload(0x2200, 2, In(1s))->data());
  ASSERT_GT(total, 64u);
  EXPECT_EQ(lost, total - 64);
  EXPECT_EQ(board_.ReadNewLogRecords(In(2s))->size(), 64u);
}

TEST_F(CanImuBoardTest, HeartbeatKeepsTheBoardUnlocked) {
  const std::uint8_t key[] = {0x54, 0x45, 0x53, 0x54};
  ASSERT_TRUE(board_.sdo().Download(0x2101, 1, key, In(1s)));
  const auto unlocked = [this] {
    return zro::GetU32(board_.sdo().Upload(0x2101, 1, In(1s))->data()) == 1;
  };
  for (int i = 0; i < 6; ++i) {
    Let(500ms);
    ASSERT_TRUE(board_.SendHeartbeat());
  }
  EXPECT_TRUE(unlocked());
  Let(1600ms);
  EXPECT_FALSE(unlocked());
}

TEST_F(CanImuBoardTest, ListenerSeesEveryFrameInBusOrder) {
  ASSERT_TRUE(board_.sdo().Upload(0x1018, 4, In(1s)));
  Let(100ms);
  std::size_t own = 0;
  for (std::size_t i = 0; i < tap_.frames.size(); ++i) {
    if (i > 0) {
      EXPECT_LE(tap_.frames[i - 1].at, tap_.frames[i].at);
    }
    own += tap_.frames[i].own ? 1 : 0;
  }
  EXPECT_EQ(own, 1u);
  EXPECT_EQ(tap_.frames.front().frame.id, 0x710u) << "the boot-up";
  EXPECT_EQ(tap_.frames.size(), world_.bus.health().received + world_.bus.health().sent);
}

TEST(LogRecord, ParsesWhatTheBoardPacksAndChecksIt) {
  zro::Event e{};
  e.seq = 77;
  e.code = zro::Code::kDiffersFromEntry;
  e.axis = 1;
  e.bin = 24;
  e.temp_degc = -12.25f;
  e.measured_dps[1] = -0.5f;
  e.limit = 0.125f;
  e.value = 2.0f;
  std::array<std::uint8_t, 24> bytes{};
  zro::node::PackLogRecord(e, 123'456, bytes.data());
  const Result<LogRecord> r = ParseLogRecord(bytes);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->seq, 77u);
  EXPECT_EQ(r->t_us, 123'456u);
  EXPECT_EQ(r->code, zro::Code::kDiffersFromEntry);
  EXPECT_EQ(r->axis, 1);
  EXPECT_EQ(r->bin, 24);
  EXPECT_EQ(r->temp_degc, -12.25);
  EXPECT_EQ(r->measured_dps[1], -0.5);
  EXPECT_EQ(r->limit, 0.125);
  EXPECT_EQ(r->value, 2.0);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] ^= 0x10;
    EXPECT_EQ(ParseLogRecord(bytes).error().kind, Error::Kind::kProtocol) << i;
    bytes[i] ^= 0x10;
  }
}

}  // namespace
}  // namespace zrobench
