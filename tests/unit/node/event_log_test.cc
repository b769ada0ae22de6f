#include "corrector/node/event_log.h"

#include <gtest/gtest.h>

#include <cstring>

#include "corrector/bytes.h"
#include "corrector/node/crc16.h"

namespace zro::node {
namespace {

Event NumberedEvent(std::uint32_t seq) {
  Event e{};
  e.seq = seq;
  e.code = Code::kMotion;
  return e;
}

class EventLogTest : public testing::Test {
 protected:
  void Fill(std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) log_.Put(NumberedEvent(first + i), 0);
  }
  std::uint32_t FirstSeq() {
    std::uint8_t records[EventLog::kMaxRead * kLogRecordBytes];
    return log_.Peek(records) == 0 ? 0 : GetU32(records);
  }
  EventLog log_;
};

TEST(LogRecord, LayoutByteForByte) {
  Event e{};
  e.seq = 0x01020304;
  e.code = Code::kDiffersFromEstimate;
  e.axis = 2;
  e.bin = 25;
  e.temp_degc = -1.5f;
  e.measured_dps[0] = 1.0f;
  e.measured_dps[1] = -0.5f;
  e.measured_dps[2] = 1000.0f;  // saturates
  e.limit = 0.25f;
  e.value = 3.0f;
  std::uint8_t r[kLogRecordBytes];
  PackLogRecord(e, 0x0A0B0C0D, r);
  const std::uint8_t expected[22] = {4,    3,    2,    1,    0x0D, 0x0C, 0x0B, 0x0A,
                                     0x80, 0xFE, 15,   0x99, 0x00, 0x01, 0x80, 0xFF,
                                     0xFF, 0x7F, 0x40, 0x00, 0x00, 0x03};
  EXPECT_EQ(std::memcmp(r, expected, 22), 0);
  EXPECT_EQ(GetU16(r + 22), Crc16(expected, 22));
}

TEST(LogRecord, ChecksumIsCcittFalse) {
  const std::uint8_t text[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(Crc16(text, 9), 0x29B1);  // the catalogue's check value
}

TEST_F(EventLogTest, EmptyHasNothing) {
  EXPECT_EQ(FirstSeq(), 0u);
  EXPECT_EQ(log_.oldest(), 0u);
  EXPECT_EQ(log_.newest(), 0u);
}

TEST_F(EventLogTest, ReadingGoesOnWhereItEnded) {
  Fill(1, 20);
  std::uint8_t records[EventLog::kMaxRead * kLogRecordBytes];
  EXPECT_EQ(log_.Peek(records), 16u);
  EXPECT_EQ(FirstSeq(), 1u) << "looking moves nothing";
  log_.Advance(16);
  EXPECT_EQ(log_.cursor(), 17u);
  EXPECT_EQ(log_.Peek(records), 4u);
  log_.Advance(4);
  EXPECT_EQ(log_.Peek(records), 0u);
  EXPECT_EQ(log_.cursor(), 21u);
  EXPECT_EQ(log_.lost(), 0u);
}

TEST_F(EventLogTest, OverwrittenUnreadRecordsAreLost) {
  Fill(1, 100);
  EXPECT_EQ(log_.total(), 100u);
  EXPECT_EQ(log_.oldest(), 37u);
  EXPECT_EQ(log_.newest(), 100u);
  EXPECT_EQ(log_.lost(), 36u);
  EXPECT_EQ(FirstSeq(), 37u);
}

TEST_F(EventLogTest, OverwrittenReadRecordsAreNotLost) {
  Fill(1, 10);
  log_.Advance(10);
  Fill(11, 64);
  EXPECT_EQ(log_.lost(), 0u);
  Fill(75, 1);
  EXPECT_EQ(log_.lost(), 1u);
}

TEST_F(EventLogTest, CursorCanGoBackAsFarAsTheRing) {
  Fill(1, 70);
  log_.Advance(1000);
  log_.SetCursor(50);
  EXPECT_EQ(FirstSeq(), 50u);
  log_.SetCursor(0);
  EXPECT_EQ(FirstSeq(), 7u);
  log_.SetCursor(999);
  EXPECT_EQ(FirstSeq(), 0u);
}

TEST_F(EventLogTest, ClearForgetsRecordsAndCounts) {
  Fill(1, 100);
  log_.Clear();
  EXPECT_EQ(log_.total(), 0u);
  EXPECT_EQ(log_.lost(), 0u);
  Fill(101, 1);
  EXPECT_EQ(FirstSeq(), 101u);
}

}  // namespace
}  // namespace zro::node
