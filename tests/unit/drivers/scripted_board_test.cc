// The board's driver against answers that our own node would never give.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "corrector/crc32.h"
#include "corrector/node/codec.h"
#include "drivers/imu/can_imu_board.h"
#include "tests/unit/drivers/scripted_bus.h"

namespace zrobench {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

/// What a server of any make answers, frame by frame.
class Script {
 public:
  void Accept(std::uint16_t index, std::uint8_t sub) { Add({0x60, Low(index), High(index), sub}); }
  void U32(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
    Add(Encode(zro::node::SdoMsg{zro::node::SdoMsg::kTxId, 0x43, index, sub, value}));
  }
  void Bytes(std::uint16_t index, const std::vector<std::uint8_t>& bytes) {
    Add(Encode(zro::node::SdoMsg{zro::node::SdoMsg::kTxId, 0x41, index, 0,
                                 static_cast<std::uint32_t>(bytes.size())}));
    for (std::size_t at = 0; at < bytes.size(); at += 7) {
      const std::size_t n = std::min<std::size_t>(7, bytes.size() - at);
      zro::node::Frame f{0x590, 8, {}};
      f.data[0] = static_cast<std::uint8_t>((at / 7 % 2) << 4 | (7 - n) << 1 |
                                            (at + n == bytes.size() ? 1u : 0u));
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), n, f.data + 1);
      Add(f);
    }
  }
  /// One reading of an empty table whose generation is `before` and, at the end, `after`.
  void Table(std::uint32_t before, std::uint32_t after) {
    std::vector<std::uint8_t> image(zro::Table::kMaxImageBytes);
    image.resize(zro::Table().ToImage(before, image.data()));
    const std::uint32_t crc = zro::Crc32(image.data(), image.size());
    Accept(0x2004, 1);
    U32(0x2000, 7, before);
    U32(0x2000, 8, crc);
    Bytes(0x2001, image);
    U32(0x2000, 7, after);
    U32(0x2000, 8, crc);
    Accept(0x2004, 1);
  }
  std::vector<std::vector<zro::node::Frame>> answers;

 private:
  static std::uint8_t Low(std::uint16_t x) { return static_cast<std::uint8_t>(x); }
  static std::uint8_t High(std::uint16_t x) { return static_cast<std::uint8_t>(x >> 8); }
  void Add(std::initializer_list<std::uint8_t> bytes) {
    zro::node::Frame f{0x590, 8, {}};
    std::copy(bytes.begin(), bytes.end(), f.data);
    Add(f);
  }
  void Add(const zro::node::Frame& frame) { answers.push_back({frame}); }
};

class ScriptedBoardTest : public testing::Test {
 protected:
  VirtualClock clock_{0};
  ScriptedBus bus_;
  CanImuBoard board_{bus_, clock_, nullptr};
  Script script_;
};

TEST_F(ScriptedBoardTest, AFrameOlderThanTheOneBeforeIsAnErrorOfTime) {
  const zro::node::Frame frame{0x290, 8, {}};
  bus_.Show({frame, Instant(2s), false});
  bus_.Show({frame, Instant(2s), false});
  EXPECT_TRUE(board_.Pump());
  bus_.Show({frame, Instant(1999ms), false});
  const Status back = board_.Pump();
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().kind, Error::Kind::kTime);
  EXPECT_THAT(back.error().message, HasSubstr("a frame of 1.999000 s after one of 2.000000 s"));
}

TEST_F(ScriptedBoardTest, TableThatMovedIsReadOnceMore) {
  script_.Table(1, 2);
  script_.Table(2, 2);
  bus_.answers = script_.answers;
  const Result<TableSnapshot> snapshot = board_.ReadTable(Instant(1s));
  ASSERT_TRUE(snapshot) << snapshot.error().message;
  EXPECT_EQ(snapshot->generation, 2u);
  EXPECT_TRUE(bus_.answers.empty());
}

TEST_F(ScriptedBoardTest, TableThatKeepsMovingIsGivenUp) {
  script_.Table(1, 2);
  script_.Table(2, 3);
  script_.Table(3, 3);
  bus_.answers = script_.answers;
  const Result<TableSnapshot> snapshot = board_.ReadTable(Instant(1s));
  ASSERT_FALSE(snapshot);
  EXPECT_EQ(snapshot.error().kind, Error::Kind::kProtocol);
}

TEST_F(ScriptedBoardTest, ImageThatDoesNotFitItsCrcIsRefusedAndReleased) {
  script_.Table(1, 1);
  script_.answers[5][0].data[3] ^= 1;  // a bit of the image
  bus_.answers = script_.answers;
  const Result<TableSnapshot> snapshot = board_.ReadTable(Instant(1s));
  ASSERT_FALSE(snapshot);
  EXPECT_EQ(snapshot.error().kind, Error::Kind::kProtocol);
  EXPECT_THAT(snapshot.error().message, HasSubstr("CRC-32"));
  EXPECT_EQ(bus_.sent.back().data[4], 0) << "0x2004:1 = 0";
  EXPECT_TRUE(bus_.answers.empty());
}

TEST_F(ScriptedBoardTest, RecordsReadBeforeAFaultAreNotLost) {
  script_.Bytes(0x2201, std::vector<std::uint8_t>(16 * 24, 0x5A));
  bus_.answers = script_.answers;  // and then silence
  const auto records = board_.ReadNewLogRecords(Instant(1s));
  ASSERT_TRUE(records);
  EXPECT_EQ(records->size(), 16u);
  EXPECT_EQ(board_.ReadNewLogRecords(Instant(2s)).error().kind, Error::Kind::kTimeout);
}

TEST_F(ScriptedBoardTest, TornLogRecordIsAProtocolError) {
  script_.Bytes(0x2201, std::vector<std::uint8_t>(25, 0));
  bus_.answers = script_.answers;
  EXPECT_EQ(board_.ReadNewLogRecords(Instant(1s)).error().kind, Error::Kind::kProtocol);
}

TEST(ScriptedBoard, BusOffIsClosed) {
  VirtualClock clock(0);
  ScriptedBus bus;
  CanImuBoard board(bus, clock, nullptr);
  bus.state.bus_off = true;
  EXPECT_EQ(board.Pump().error().kind, Error::Kind::kClosed);
}

}  // namespace
}  // namespace zrobench
