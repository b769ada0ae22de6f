#include "drivers/link/memory_bus.h"

#include <gtest/gtest.h>

namespace zrobench {
namespace {

using zro::node::Frame;
using namespace std::chrono_literals;

class MemoryBusTest : public testing::Test {
 protected:
  VirtualClock clock_{0};
  MemoryBus bus_{clock_, 8};
};

TEST_F(MemoryBusTest, BothDirectionsInBusOrderWithOwnFramesFlagged) {
  EXPECT_FALSE(bus_.ready());
  bus_.board_sink().Send(Frame{0x290, 8, {1}});
  ASSERT_TRUE(bus_.Send(Frame{0x610, 8, {2}}));
  bus_.board_sink().Send(Frame{0x590, 8, {3}});
  EXPECT_TRUE(bus_.ready());
  const std::uint32_t ids[] = {0x290, 0x610, 0x590};
  for (int i = 0; i < 3; ++i) {
    const std::optional<CanFrame> frame = bus_.Receive();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->frame.id, ids[i]);
    EXPECT_EQ(frame->own, i == 1);
  }
  EXPECT_FALSE(bus_.Receive());
  EXPECT_EQ(bus_.BoardReceive()->data[0], 2) << "the board does not hear itself";
  EXPECT_FALSE(bus_.BoardReceive());
  EXPECT_EQ(bus_.health().received, 2u);
  EXPECT_EQ(bus_.health().sent, 1u);
}

TEST_F(MemoryBusTest, StampsWithTheClock) {
  clock_.Wait(Instant(3ms), {});
  bus_.board_sink().Send(Frame{0x290, 8, {}});
  clock_.Wait(Instant(9ms), {});
  EXPECT_EQ(bus_.Receive()->at, Instant(3ms));
}

TEST_F(MemoryBusTest, FullQueueLosesTheNewestAndCounts) {
  for (std::uint8_t i = 0; i < 11; ++i) bus_.board_sink().Send(Frame{0x290, 8, {i}});
  EXPECT_EQ(bus_.health().lost, 3u);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(bus_.Receive()->frame.data[0], i);
  EXPECT_FALSE(bus_.ready());
  bus_.board_sink().Send(Frame{0x290, 8, {99}});
  EXPECT_EQ(bus_.Receive()->frame.data[0], 99);
}

TEST_F(MemoryBusTest, OrderSurvivesManyWraps) {
  std::uint8_t in = 0, out = 0;
  for (int round = 0; round < 1000; ++round) {
    for (int i = 0; i < 3 + round % 3; ++i) bus_.board_sink().Send(Frame{1, 8, {in++}});
    for (int i = 0; i < 3 + round % 3; ++i) {
      ASSERT_EQ(bus_.Receive()->frame.data[0], out++);
      if (i == 0) bus_.board_sink().Send(Frame{1, 8, {in++}});
    }
    ASSERT_EQ(bus_.Receive()->frame.data[0], out++);
  }
  EXPECT_EQ(bus_.health().lost, 0u);
}

TEST_F(MemoryBusTest, BoardThatTakesNothingIsATimeout) {
  Status status;
  int sent = 0;
  while ((status = bus_.Send(Frame{0x610, 8, {}})) && sent < 100'000) ++sent;
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, Error::Kind::kTimeout);
  EXPECT_GT(sent, 100);
}

}  // namespace
}  // namespace zrobench
