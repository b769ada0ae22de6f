// The object dictionary, read and written through the node.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "corrector/crc32.h"
#include "tests/unit/node/board_fixture.h"

namespace zro::node {
namespace {

class ObjectsTest : public testing::Test {
 protected:
  void SetUp() override { board_.node.Boot(BootReason::kPowerOn, 1); }
  static std::uint32_t Bits(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    return bits;
  }
  /// Abort code, 0 when written.
  std::uint32_t Write(std::uint16_t index, std::uint8_t sub, std::uint32_t value, int bytes) {
    const SdoMsg reply = board_.Write(index, sub, value, bytes);
    return reply.cmd == 0x60 ? 0 : reply.data;
  }
  std::vector<std::uint8_t> Upload(std::uint16_t index, std::uint8_t sub) {
    SdoMsg reply = board_.Read(index, sub);
    std::vector<std::uint8_t> bytes;
    if (reply.cmd != 0x41) return bytes;
    std::uint8_t toggle = 0;
    do {
      const std::size_t before = board_.sink.frames.size();
      board_.node.OnFrame(Frame{0x610, 8, {static_cast<std::uint8_t>(0x60 | toggle)}});
      const Frame& f = board_.sink.frames.at(before);
      bytes.insert(bytes.end(), f.data + 1, f.data + 8 - (f.data[0] >> 1 & 7));
      if (f.data[0] & 1) return bytes;
      toggle ^= 0x10;
    } while (true);
  }
  void Learn() { board_.Run(6000); }

  Board board_;
  std::uint32_t now_ms_ = 0;
};

TEST_F(ObjectsTest, EverySubZeroGivesTheHighestSub) {
  const std::pair<int, unsigned> kHighest[] = {{0x1010, 4}, {0x1018, 4}, {0x2000, 10}, {0x2004, 2},
                                               {0x2100, 9}, {0x2101, 6}, {0x2200, 6}};
  for (const auto& [index, highest] : kHighest) {
    const SdoMsg reply = board_.Read(static_cast<std::uint16_t>(index), 0);
    EXPECT_EQ(reply.cmd, 0x4F);
    EXPECT_EQ(reply.data, highest) << std::hex << index;
  }
}

TEST_F(ObjectsTest, IdentityInWords) {
  const std::vector<std::uint8_t> version = Upload(0x100A, 0);
  EXPECT_EQ(std::string(version.begin(), version.end()), "1.12.103");
  EXPECT_EQ(board_.Read(0x1009, 0).data, std::uint32_t{'4'});
  EXPECT_EQ(board_.Read(0x1018, 4).data, 0x12345u);
}

TEST_F(ObjectsTest, AbsentTestObjectsAreAbsent) {
  for (std::uint8_t sub = 3; sub <= 5; ++sub) EXPECT_EQ(Write(0x2101, sub, 1, 1), 0x06090011u);
  EXPECT_EQ(Write(0x2002, 0, 1, 1), 0x06020000u);
  EXPECT_EQ(Write(0x2003, 0, 1, 1), 0x06020000u);
}

TEST_F(ObjectsTest, HeaderDescribesTheImage) {
  Learn();
  const std::vector<std::uint8_t> image = Upload(0x2001, 0);
  ASSERT_GE(image.size(), Table::kHeaderBytes + Table::kEntryBytes);
  Table table;
  std::uint32_t generation = 0;
  ASSERT_TRUE(table.FromImage(image.data(), image.size(), &generation));
  EXPECT_EQ(board_.Read(0x2000, 1).data, Table::kLayoutVersion);
  EXPECT_EQ(board_.Read(0x2000, 2).data, static_cast<std::uint32_t>(table.size()));
  EXPECT_EQ(board_.Read(0x2000, 7).data, generation);
  EXPECT_EQ(board_.Read(0x2000, 8).data, Crc32(image.data(), image.size()));
  EXPECT_EQ(board_.Read(0x2000, 10).data, 2u) << "learned";
}

TEST_F(ObjectsTest, FreezeHoldsTheTableStill) {
  EXPECT_EQ(board_.Read(0x2004, 2).data, static_cast<std::uint32_t>(SdoAbort::kWrongState));
  EXPECT_EQ(Write(0x2004, 1, 1, 1), 0u);
  const std::uint32_t frozen_crc = board_.Read(0x2000, 8).data;
  const std::uint32_t frozen_generation = board_.Read(0x2004, 2).data;
  Learn();
  ASSERT_GE(board_.node.corrector().table().size(), 1);
  EXPECT_EQ(board_.Read(0x2000, 8).data, frozen_crc);
  EXPECT_EQ(board_.Read(0x2000, 7).data, frozen_generation);
  EXPECT_EQ(board_.Read(0x2000, 2).data, 0u);
  EXPECT_EQ(Write(0x2004, 1, 2, 1), 0x06090030u);
  EXPECT_EQ(Write(0x2004, 1, 0, 1), 0u);
  EXPECT_NE(board_.Read(0x2000, 8).data, frozen_crc);
  EXPECT_GE(board_.Read(0x2000, 2).data, 1u);
}

TEST_F(ObjectsTest, LimitsAreReadBackAndKeptWithinReason) {
  EXPECT_EQ(Write(0x2100, 1, 3, 1), 0u);
  EXPECT_EQ(Write(0x2100, 2, Bits(3.5f), 4), 0u);
  EXPECT_EQ(Write(0x2100, 6, 500, 2), 0u);
  EXPECT_EQ(Write(0x2100, 8, static_cast<std::uint16_t>(-10 * 256), 2), 0u);
  const Limits& limits = board_.node.corrector().limits();
  EXPECT_EQ(limits.mode, Mode::kFrozen);
  EXPECT_EQ(limits.max_bias_dps, 3.5f);
  EXPECT_EQ(limits.min_samples, 500);
  EXPECT_EQ(limits.min_temp_degc, -10.0f);
  EXPECT_EQ(board_.Read(0x2100, 2).data, Bits(3.5f));
  EXPECT_EQ(board_.Read(0x2100, 8).data & 0xFFFF, static_cast<std::uint16_t>(-10 * 256));

  EXPECT_EQ(Write(0x2100, 1, 4, 1), 0x06090030u);
  EXPECT_EQ(Write(0x2100, 2, Bits(-1.0f), 4), 0x06090030u);
  EXPECT_EQ(Write(0x2100, 3, 0x7FC00000, 4), 0x06090030u);  // NaN
  EXPECT_EQ(Write(0x2100, 4, 0x7F800000, 4), 0x06090030u);  // infinity
  EXPECT_EQ(Write(0x2100, 6, 1, 2), 0x06090030u);
  EXPECT_EQ(Write(0x2100, 7, Bits(0.9f), 4), 0x06090030u);
  EXPECT_EQ(Write(0x2100, 9, static_cast<std::uint16_t>(-20 * 256), 2), 0x06090030u);
  EXPECT_EQ(limits.max_bias_dps, 3.5f);
}

TEST_F(ObjectsTest, ConfigurationCrcFollowsTheLimits) {
  const std::uint32_t before = board_.sink.All<IdentMsg>().at(3).config_crc32;
  Write(0x2100, 3, Bits(0.123f), 4);
  board_.node.OnTime(10'000);
  EXPECT_NE(board_.sink.All<IdentMsg>().at(7).config_crc32, before);
}

TEST_F(ObjectsTest, StoringNeedsTheSignatureAndAWorkingStore) {
  EXPECT_EQ(Write(0x1010, 1, 0x12345678, 4), 0x08000020u);
  EXPECT_EQ(Write(0x1011, 4, kSaveSignature, 4), 0x08000020u);
  EXPECT_EQ(Write(0x1010, 4, kSaveSignature, 4), 0u);
  board_.storage.broken = true;
  Learn();  // something to store
  ASSERT_TRUE(board_.node.corrector().dirty());
  EXPECT_EQ(Write(0x1010, 1, kSaveSignature, 4), 0x08000020u);
}

TEST_F(ObjectsTest, RestoreDropsWhatWasLearned) {
  Learn();
  ASSERT_GE(board_.node.corrector().table().size(), 1);
  EXPECT_EQ(Write(0x1011, 1, kLoadSignature, 4), 0u);
  EXPECT_EQ(board_.node.corrector().table().size(), 0);
}

TEST_F(ObjectsTest, InjectionNeedsTheKeyAndSparesDutRaw) {
  const auto inject = [this] {
    board_.node.OnFrame(Frame{0x610, 8, {0x21, 0x01, 0x21, 2, 6}});
    const std::size_t before = board_.sink.frames.size();
    board_.node.OnFrame(Frame{0x610, 8, {0x03, 0x00, 0x04, 0, 0, 0, 0}});  // 1024 LSB on x
    return board_.sink.frames.at(before).data[0];
  };
  EXPECT_EQ(inject(), 0x80);
  EXPECT_EQ(Write(0x2101, 1, 0x11111111, 4), 0x06090030u);
  EXPECT_EQ(Write(0x2101, 1, TestModes::kKey, 4), 0u);
  board_.Run(1);
  const RateMsg before = board_.sink.All<RateMsg>().back();
  EXPECT_FALSE(before.test_mode);
  EXPECT_EQ(inject(), 0x20);
  board_.Run(1);
  const RateMsg after = board_.sink.All<RateMsg>().back();
  EXPECT_TRUE(after.test_mode);
  EXPECT_NEAR(after.rate[0] - before.rate[0], 1024 * 250.0 / 32768 * 256, 30);
  EXPECT_LT(board_.sink.All<RawMsg>().back().raw[0], 100);
}

TEST_F(ObjectsTest, FactoryEntriesNeedTheKey) {
  const auto download = [this] {
    board_.node.OnFrame(Frame{0x610, 8, {0x21, 0x05, 0x20, 0, 20}});
    std::size_t last = 0;
    for (std::uint8_t i = 0; i < 3; ++i) {  // one entry of zeros
      last = board_.sink.frames.size();
      const auto command = static_cast<std::uint8_t>(i % 2 << 4 | (i == 2 ? 3 : 0));
      board_.node.OnFrame(Frame{0x610, 8, {command}});
    }
    return board_.sink.frames.at(last).data[0];
  };
  EXPECT_EQ(download(), 0x80);
  EXPECT_EQ(board_.node.corrector().table().size(), 0);
  EXPECT_EQ(Write(0x2101, 1, TestModes::kKey, 4), 0u);
  EXPECT_EQ(download(), 0x20);
  EXPECT_EQ(board_.node.corrector().table().size(), 1);
}

TEST_F(ObjectsTest, TestModesEndWithTheRigsHeartbeat) {
  Write(0x2101, 1, TestModes::kKey, 4);
  board_.Run(300);
  EXPECT_EQ(board_.Read(0x2101, 1).data, 1u) << "1.5 s not yet over";
  board_.node.OnFrame(Encode(HeartbeatMsg{HeartbeatMsg::kRigId, kStateOperational}));
  board_.Run(300);
  EXPECT_EQ(board_.Read(0x2101, 1).data, 1u);
  board_.Run(1);
  EXPECT_EQ(board_.Read(0x2101, 1).data, 0u);
}

TEST_F(ObjectsTest, LoadNeedsTheKeyIsAShareAndEndsWithTheLockOrTheHeartbeat) {
  EXPECT_EQ(Write(0x2101, 6, 40, 1), 0x08000022u) << "locked";
  Write(0x2101, 1, TestModes::kKey, 4);
  EXPECT_EQ(Write(0x2101, 6, 101, 1), 0x06090030u);
  EXPECT_EQ(board_.node.load_pct(), 0);
  EXPECT_EQ(Write(0x2101, 6, 40, 1), 0u);
  EXPECT_EQ(board_.node.load_pct(), 40);
  EXPECT_EQ(board_.Read(0x2101, 6).data & 0xFF, 40u);
  Write(0x2101, 1, 0, 4);
  EXPECT_EQ(board_.node.load_pct(), 0);
  Write(0x2101, 1, TestModes::kKey, 4);
  Write(0x2101, 6, 40, 1);
  board_.Run(301);
  EXPECT_EQ(board_.node.load_pct(), 0) << "the rig fell silent for 1.5 s";
}

TEST_F(ObjectsTest, UnderLoadTheCorrectorGoesOnLearning) {
  Write(0x2101, 1, TestModes::kKey, 4);
  Write(0x2101, 6, 100, 1);
  for (int s = 0; s < 20; ++s) {
    board_.node.OnFrame(Encode(HeartbeatMsg{HeartbeatMsg::kRigId, kStateOperational}));
    board_.Run(200);
  }
  EXPECT_EQ(board_.node.load_pct(), 100);
  EXPECT_FALSE(board_.sink.All<RateMsg>().back().test_mode);
  EXPECT_GE(board_.node.corrector().table().size(), 1);
}

TEST_F(ObjectsTest, LearningIsRefusedInATestMode) {
  Write(0x2101, 1, TestModes::kKey, 4);
  board_.node.OnFrame(Frame{0x610, 8, {0x21, 0x01, 0x21, 2, 6}});
  board_.node.OnFrame(Frame{0x610, 8, {0x03, 0x01, 0, 0, 0, 0, 0}});
  for (int i = 0; i < 30; ++i) {
    board_.Run(200);
    board_.node.OnFrame(Encode(HeartbeatMsg{HeartbeatMsg::kRigId, kStateOperational}));
  }
  EXPECT_EQ(board_.node.corrector().table().size(), 0);
  const std::vector<EmcyMsg> emcy = board_.sink.All<EmcyMsg>();
  ASSERT_FALSE(emcy.empty());
  EXPECT_EQ(emcy.back().reason, 16);
}

TEST_F(ObjectsTest, LogMovesOnOnlyWhenReadToTheEnd) {
  Learn();
  ASSERT_GE(board_.Read(0x2200, 1).data, 1u);
  const std::uint32_t first = board_.Read(0x2200, 6).data;
  board_.Read(0x2201, 0);  // begun, not finished
  EXPECT_EQ(board_.Read(0x2200, 6).data, first);
  const std::vector<std::uint8_t> records = Upload(0x2201, 0);
  EXPECT_EQ(records.size() % kLogRecordBytes, 0u);
  EXPECT_EQ(board_.Read(0x2200, 6).data, board_.Read(0x2200, 4).data + 1);
  EXPECT_EQ(Write(0x2200, 5, 1, 4), 0x06090030u);
  EXPECT_EQ(Write(0x2200, 5, kClearSignature, 4), 0u);
  EXPECT_EQ(board_.Read(0x2200, 1).data, 0u);
}

TEST_F(ObjectsTest, LogThatMovesDuringItsUploadSkipsNothing) {
  const auto stir = [this] {  // a still cut short: one event
    board_.Run(600);
    for (int n = 0; n < 40; ++n) {
      RawSample moved = board_.Next();
      moved.accel[0] = static_cast<std::int16_t>(n % 2 ? 3000 : -3000);
      board_.node.OnSample(moved);
    }
  };
  while (board_.node.log().total() < EventLog::kCapacity) stir();
  ASSERT_EQ(board_.Read(0x2200, 6).data, 0u);
  board_.Read(0x2201, 0);  // begun: records 0..15
  while (board_.node.log().total() < EventLog::kCapacity + 3) stir();
  for (std::uint8_t toggle = 0, last = 0; !last; toggle ^= 0x10) {
    const std::size_t before = board_.sink.frames.size();
    board_.node.OnFrame(Frame{0x610, 8, {static_cast<std::uint8_t>(0x60 | toggle)}});
    last = board_.sink.frames.at(before).data[0] & 1;
  }
  EXPECT_EQ(board_.Read(0x2200, 6).data, 16u);
}

TEST_F(ObjectsTest, StatusTellsAFailingStoreAndItsRecovery) {
  const auto nv_state = [this] {
    now_ms_ += 1000;
    board_.node.OnTime(now_ms_);
    return static_cast<int>(board_.sink.All<StatusMsg>().back().nv_state);
  };
  EXPECT_EQ(nv_state(), 0);
  board_.storage.broken = true;
  Learn();
  EXPECT_EQ(nv_state(), 3);
  board_.storage.broken = false;
  EXPECT_EQ(Write(0x1010, 1, kSaveSignature, 4), 0u);
  EXPECT_EQ(nv_state(), 0);
  Write(0x2101, 1, TestModes::kKey, 4);
  board_.node.OnFrame(Frame{0x610, 8, {0x21, 0x05, 0x20, 0, 20}});
  for (std::uint8_t i = 0; i < 3; ++i) {  // one factory entry of zeros, not saved
    const auto command = static_cast<std::uint8_t>(i % 2 << 4 | (i == 2 ? 3 : 0));
    board_.node.OnFrame(Frame{0x610, 8, {command}});
  }
  EXPECT_EQ(nv_state(), 1) << "dirty, and no longer failing";
}

RC_GTEST_PROP(Garbage, NeitherCrashesNorWedgesTheNode,
              (const std::vector<std::array<std::uint8_t, 10>>& noise)) {
  Board board;
  board.node.Boot(BootReason::kPowerOn, 1);
  static constexpr std::uint32_t kIds[] = {0x610, 0x610, 0x610, 0x100, 0x77E, 0x7FF, 0x590};
  static constexpr std::uint16_t kIndices[] = {0x1010, 0x1011, 0x2001, 0x2004,
                                               0x2005, 0x2100, 0x2101, 0x2201};
  for (const auto& bytes : noise) {
    Frame frame{kIds[bytes[0] % 7], static_cast<std::uint8_t>(bytes[1] % 9), {}};
    std::copy_n(bytes.begin() + 2, 8, frame.data);
    if (bytes[0] & 0x80) {  // half of them close to sense
      frame.dlc = 8;
      const std::uint16_t index = kIndices[bytes[3] % 8];
      frame.data[1] = static_cast<std::uint8_t>(index);
      frame.data[2] = static_cast<std::uint8_t>(index >> 8);
      frame.data[3] = bytes[5] % 11;
    }
    board.node.OnFrame(frame);
    board.Run(1);
  }
  const SdoMsg reply = board.Read(0x1018, 4);
  RC_ASSERT(reply.cmd == 0x43);
  RC_ASSERT(reply.data == kTestIdentity.serial);
}

}  // namespace
}  // namespace zro::node
