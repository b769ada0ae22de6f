#include "drivers/imu/sdo_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/drivers/scripted_bus.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using zro::node::Frame;
using namespace std::chrono_literals;

/// The client against frames written by hand from CiA 301, 7.2.4.3.
class SdoClientTest : public testing::Test {
 protected:
  Status Pump() {
    while (const std::optional<CanFrame> frame = bus_.Receive()) client_.OnFrame(frame->frame);
    return {};
  }
  static Frame Reply(std::initializer_list<std::uint8_t> bytes) {
    Frame f{0x590, 8, {}};
    std::copy(bytes.begin(), bytes.end(), f.data);
    return f;
  }
  static std::vector<std::uint8_t> BytesOf(const Frame& f) { return {f.data, f.data + 8}; }

  VirtualClock clock_{0};
  ScriptedBus bus_;
  SdoClient client_{bus_, clock_, [this] { return Pump(); }};
  Instant deadline_ = Instant(100ms);
};

TEST_F(SdoClientTest, ExpeditedUpload) {
  bus_.answers = {{Reply({0x4B, 0x17, 0x10, 0, 0xF4, 0x01})}};
  const auto bytes = client_.Upload(0x1017, 0, deadline_);
  ASSERT_TRUE(bytes);
  EXPECT_THAT(*bytes, ElementsAre(0xF4, 0x01));
  ASSERT_EQ(bus_.sent.size(), 1u);
  EXPECT_EQ(bus_.sent[0].id, 0x610u);
  EXPECT_THAT(BytesOf(bus_.sent[0]), ElementsAre(0x40, 0x17, 0x10, 0, 0, 0, 0, 0));
}

TEST_F(SdoClientTest, SegmentedUpload) {
  bus_.answers = {{Reply({0x41, 0x01, 0x20, 0, 9})},
                  {Reply({0x00, 1, 2, 3, 4, 5, 6, 7})},
                  {Reply({0x1B, 8, 9})}};
  const auto bytes = client_.Upload(0x2001, 0, deadline_);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_THAT(*bytes, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_EQ(bus_.sent[1].data[0], 0x60);
  EXPECT_EQ(bus_.sent[2].data[0], 0x70);
}

TEST_F(SdoClientTest, ExpeditedAndSegmentedDownload) {
  bus_.answers = {{Reply({0x60, 0x04, 0x20, 1})},
                  {Reply({0x60, 0x05, 0x20, 0})},
                  {Reply({0x20})},
                  {Reply({0x30})}};
  const std::uint8_t one[] = {1};
  EXPECT_TRUE(client_.Download(0x2004, 1, one, deadline_));
  EXPECT_THAT(BytesOf(bus_.sent[0]), ElementsAre(0x2F, 0x04, 0x20, 1, 1, 0, 0, 0));
  const std::uint8_t nine[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_TRUE(client_.Download(0x2005, 0, nine, deadline_));
  EXPECT_THAT(BytesOf(bus_.sent[1]), ElementsAre(0x21, 0x05, 0x20, 0, 9, 0, 0, 0));
  EXPECT_THAT(BytesOf(bus_.sent[2]), ElementsAre(0x00, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(BytesOf(bus_.sent[3]), ElementsAre(0x1B, 8, 9, 0, 0, 0, 0, 0));
}

TEST_F(SdoClientTest, ServersAbortIsARefusalInWords) {
  bus_.answers = {{Reply({0x80, 0x05, 0x20, 0, 0x22, 0x00, 0x00, 0x08})}};
  const std::uint8_t one[] = {1};
  const Status status = client_.Download(0x2005, 0, one, deadline_);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, Error::Kind::kRefused);
  EXPECT_THAT(status.error().message, HasSubstr("0x2005:0"));
  EXPECT_THAT(status.error().message, HasSubstr(SdoAbortText(0x08000022)));
  EXPECT_EQ(bus_.sent.size(), 1u) << "no abort in answer to an abort";
}

TEST_F(SdoClientTest, SilenceEndsAtTheDeadlineWithAnAbort) {
  const auto bytes = client_.Upload(0x2001, 0, deadline_);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().kind, Error::Kind::kTimeout);
  EXPECT_EQ(clock_.now(), deadline_);
  ASSERT_EQ(bus_.sent.size(), 2u);
  EXPECT_THAT(BytesOf(bus_.sent[1]), ElementsAre(0x80, 0x01, 0x20, 0, 0, 0, 0x04, 0x05));
}

TEST_F(SdoClientTest, SilenceInMidTransferAlsoAborts) {
  bus_.answers = {{Reply({0x41, 0x01, 0x20, 0, 90})}, {Reply({0x00, 1, 2, 3, 4, 5, 6, 7})}};
  const auto bytes = client_.Upload(0x2001, 0, deadline_);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().kind, Error::Kind::kTimeout);
  EXPECT_THAT(BytesOf(bus_.sent.back()), ElementsAre(0x80, 0x01, 0x20, 0, 0, 0, 0x04, 0x05));
}

TEST_F(SdoClientTest, ToggleErrorsAreAborted) {
  bus_.answers = {{Reply({0x41, 0x01, 0x20, 0, 9})}, {Reply({0x10, 1, 2, 3, 4, 5, 6, 7})}};
  const auto bytes = client_.Upload(0x2001, 0, deadline_);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().kind, Error::Kind::kProtocol);
  EXPECT_THAT(BytesOf(bus_.sent.back()), ElementsAre(0x80, 0x01, 0x20, 0, 0, 0, 0x03, 0x05));
  bus_.answers = {{Reply({0x60, 0x05, 0x20, 0})}, {Reply({0x30})}};
  const std::uint8_t nine[9] = {};
  const Status status = client_.Download(0x2005, 0, nine, deadline_);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, Error::Kind::kProtocol);
  EXPECT_THAT(BytesOf(bus_.sent.back()), ElementsAre(0x80, 0x05, 0x20, 0, 0, 0, 0x03, 0x05));
}

TEST_F(SdoClientTest, LateAnswerToAnotherObjectIsPassedOver) {
  bus_.answers = {{Reply({0x43, 0x00, 0x20, 7, 9, 9, 9, 9}), Reply({0x80, 0x00, 0x20, 7}),
                   Reply({0x4F, 0x04, 0x20, 1, 1})}};
  const auto bytes = client_.Upload(0x2004, 1, deadline_);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_THAT(*bytes, ElementsAre(1));
}

TEST_F(SdoClientTest, LengthsThatDoNotFitAreProtocolErrors) {
  bus_.answers = {{Reply({0x41, 0x01, 0x20, 0, 3})}, {Reply({0x01, 1, 2, 3, 4, 5, 6, 7})}};
  EXPECT_EQ(client_.Upload(0x2001, 0, deadline_).error().kind, Error::Kind::kProtocol);
  bus_.answers = {{Reply({0x41, 0x01, 0x20, 0, 9})}, {Reply({0x01, 1, 2, 3, 4, 5, 6, 7})}};
  EXPECT_EQ(client_.Upload(0x2001, 0, deadline_).error().kind, Error::Kind::kProtocol);
  bus_.answers = {{Reply({0x41, 0x01, 0x20, 0, 0, 0, 0, 0x7F})}};
  EXPECT_EQ(client_.Upload(0x2001, 0, deadline_).error().kind, Error::Kind::kProtocol);
  EXPECT_EQ(bus_.sent.back().data[0], 0x80);
}

}  // namespace
}  // namespace zrobench
