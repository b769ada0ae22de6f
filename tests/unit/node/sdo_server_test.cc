// The SDO server against byte exchanges written by hand from CiA 301, 7.2.4.3.
#include "corrector/node/sdo_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <vector>

namespace zro::node {
namespace {

using Bytes = std::array<std::uint8_t, 8>;
using testing::ElementsAre;

class Replies final : public FrameSink {
 public:
  void Send(const Frame& frame) override {
    EXPECT_EQ(frame.id, 0x590u);
    EXPECT_EQ(frame.dlc, 8);
    std::copy_n(frame.data, 8, sent.emplace_back().begin());
  }
  std::vector<Bytes> sent;
};

/// 0x2000:1 u32 rw, 0x2000:2 u16 ro, 0x3000 DOMAIN rw, 0x3001 u32 wo.
class FakeObjects final : public SdoObjects {
 public:
  const SdoObject* Find(std::uint16_t index, std::uint8_t sub, SdoAbort* abort) override {
    static constexpr SdoObject kRows[] = {{0x2000, 1, 1, SdoAccess::kReadWrite, 4},
                                          {0x2000, 2, 2, SdoAccess::kReadOnly, 2},
                                          {0x3000, 0, 0, SdoAccess::kReadWrite, 0},
                                          {0x3001, 0, 0, SdoAccess::kWriteOnly, 4}};
    *abort = SdoAbort::kNoObject;
    for (const SdoObject& row : kRows) {
      if (row.index == index && row.first_sub == sub) return &row;
      if (row.index == index) *abort = SdoAbort::kNoSub;
    }
    return nullptr;
  }
  SdoAbort Read(std::uint16_t index, std::uint8_t sub, std::uint8_t* out, std::size_t capacity,
                std::size_t* size) override {
    const std::vector<std::uint8_t>& value = values[{index, sub}];
    EXPECT_LE(value.size(), capacity);
    std::copy(value.begin(), value.end(), out);
    *size = value.size();
    return SdoAbort::kNone;
  }
  SdoAbort Write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* bytes,
                 std::size_t size) override {
    if (size > 0 && bytes[0] == 0xEE) return SdoAbort::kRange;
    values[{index, sub}].assign(bytes, bytes + size);
    ++writes;
    return SdoAbort::kNone;
  }
  void OnUploaded(std::uint16_t, std::uint8_t) override { ++uploads; }

  std::map<std::pair<std::uint16_t, std::uint8_t>, std::vector<std::uint8_t>> values;
  int writes = 0, uploads = 0;
};

class SdoServerTest : public testing::Test {
 protected:
  /// The answer to a request; nothing when the server stays silent.
  std::optional<Bytes> Ask(const Bytes& request) {
    Frame frame{0x610, 8, {}};
    std::copy(request.begin(), request.end(), frame.data);
    replies_.sent.clear();
    server_.OnFrame(frame);
    EXPECT_LE(replies_.sent.size(), 1u);
    if (replies_.sent.empty()) return std::nullopt;
    return replies_.sent[0];
  }

  FakeObjects objects_;
  Replies replies_;
  SdoServer server_{&objects_, &replies_};
};

TEST_F(SdoServerTest, ExpeditedUploadStatesTheSize) {
  objects_.values[{0x2000, 1}] = {0x78, 0x56, 0x34, 0x12};
  EXPECT_EQ(Ask({0x40, 0x00, 0x20, 1}), (Bytes{0x43, 0x00, 0x20, 1, 0x78, 0x56, 0x34, 0x12}));
  objects_.values[{0x2000, 2}] = {0xCD, 0xAB};
  EXPECT_EQ(Ask({0x40, 0x00, 0x20, 2}), (Bytes{0x4B, 0x00, 0x20, 2, 0xCD, 0xAB}));
  EXPECT_EQ(objects_.uploads, 2);
}

TEST_F(SdoServerTest, SegmentedUpload) {
  objects_.values[{0x3000, 0}] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(Ask({0x40, 0x00, 0x30, 0}), (Bytes{0x41, 0x00, 0x30, 0, 9, 0, 0, 0}));
  EXPECT_EQ(Ask({0x60}), (Bytes{0x00, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(objects_.uploads, 0);
  EXPECT_EQ(Ask({0x70}), (Bytes{0x1B, 8, 9}));  // toggle, 5 bytes unused, last
  EXPECT_EQ(objects_.uploads, 1);
}

TEST_F(SdoServerTest, UploadOfNothingIsOneEmptySegment) {
  EXPECT_EQ(Ask({0x40, 0x00, 0x30, 0}), (Bytes{0x41, 0x00, 0x30, 0}));
  EXPECT_EQ(Ask({0x60}), (Bytes{0x0F}));
  EXPECT_EQ(objects_.uploads, 1);
}

TEST_F(SdoServerTest, UploadOfWholeSegmentsHasNoEmptyTail) {
  objects_.values[{0x3000, 0}] = std::vector<std::uint8_t>(14, 0xAA);
  Ask({0x40, 0x00, 0x30, 0});
  EXPECT_EQ((*Ask({0x60}))[0], 0x00);
  EXPECT_EQ((*Ask({0x70}))[0], 0x11);
}

TEST_F(SdoServerTest, ExpeditedDownload) {
  EXPECT_EQ(Ask({0x23, 0x00, 0x20, 1, 1, 2, 3, 4}), (Bytes{0x60, 0x00, 0x20, 1}));
  EXPECT_THAT((objects_.values[{0x2000, 1}]), ElementsAre(1, 2, 3, 4));
  // Size not stated: the object's own.
  EXPECT_EQ(Ask({0x22, 0x00, 0x20, 1, 5, 6, 7, 8}), (Bytes{0x60, 0x00, 0x20, 1}));
  EXPECT_THAT((objects_.values[{0x2000, 1}]), ElementsAre(5, 6, 7, 8));
}

TEST_F(SdoServerTest, SegmentedDownload) {
  EXPECT_EQ(Ask({0x21, 0x00, 0x30, 0, 10}), (Bytes{0x60, 0x00, 0x30, 0}));
  EXPECT_EQ(Ask({0x00, 1, 2, 3, 4, 5, 6, 7}), (Bytes{0x20}));
  EXPECT_EQ(objects_.writes, 0) << "takes effect at the end only";
  EXPECT_EQ(Ask({0x19, 8, 9, 10}), (Bytes{0x30}));  // toggle, 4 unused, last
  EXPECT_THAT((objects_.values[{0x3000, 0}]), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
}

TEST_F(SdoServerTest, ToggleErrorsAbortBothWays) {
  objects_.values[{0x3000, 0}] = std::vector<std::uint8_t>(20, 1);
  Ask({0x40, 0x00, 0x30, 0});
  Ask({0x60});
  EXPECT_EQ(Ask({0x60}), (Bytes{0x80, 0x00, 0x30, 0, 0, 0, 0x03, 0x05}));
  EXPECT_EQ(Ask({0x70}), (Bytes{0x80, 0x00, 0x30, 0, 0x01, 0, 0x04, 0x05})) << "transfer is over";
  Ask({0x21, 0x00, 0x30, 0, 14});
  EXPECT_EQ(Ask({0x10, 1}), (Bytes{0x80, 0x00, 0x30, 0, 0, 0, 0x03, 0x05}));
  EXPECT_EQ(objects_.writes, 0);
}

TEST_F(SdoServerTest, AbortCodes) {
  const auto code = [this](const Bytes& request) {
    const std::optional<Bytes> reply = Ask(request);
    if (!reply || (*reply)[0] != 0x80) return 0u;
    EXPECT_EQ((*reply)[1], request[1]);
    EXPECT_EQ((*reply)[2], request[2]);
    EXPECT_EQ((*reply)[3], request[3]);
    std::uint32_t value = 0;
    std::memcpy(&value, reply->data() + 4, 4);
    return value;
  };
  EXPECT_EQ(code({0x40, 0x34, 0x12, 0}), 0x06020000u);  // no object
  EXPECT_EQ(code({0x23, 0x34, 0x12, 0}), 0x06020000u);
  EXPECT_EQ(code({0x40, 0x00, 0x20, 9}), 0x06090011u);        // no sub-index
  EXPECT_EQ(code({0x40, 0x01, 0x30, 0}), 0x06010001u);        // write-only
  EXPECT_EQ(code({0x2B, 0x00, 0x20, 2}), 0x06010002u);        // read-only
  EXPECT_EQ(code({0x2B, 0x00, 0x20, 1, 1, 2}), 0x06070010u);  // two bytes for four
  EXPECT_EQ(code({0x21, 0x00, 0x20, 1, 5}), 0x06070010u);
  EXPECT_EQ(code({0x21, 0x00, 0x30, 0, 0, 0, 1}), 0x06070010u);  // longer than any object
  EXPECT_EQ(code({0x23, 0x00, 0x20, 1, 0xEE}), 0x06090030u);     // the object says no
  EXPECT_EQ(code({0xA0, 0x00, 0x30, 0}), 0x05040001u);           // block upload
  EXPECT_EQ(objects_.writes, 0);
}

TEST_F(SdoServerTest, DownloadOfAnotherLengthThanAnnouncedIsNotWritten) {
  Ask({0x21, 0x00, 0x30, 0, 9});
  EXPECT_EQ(Ask({0x01, 1, 2, 3, 4, 5, 6, 7}), (Bytes{0x80, 0x00, 0x30, 0, 0x10, 0, 0x07, 0x06}));
  EXPECT_EQ(objects_.writes, 0);
}

TEST_F(SdoServerTest, EndlessDownloadIsCutAtTheBuffer) {
  Ask({0x20, 0x00, 0x30, 0});  // size not stated
  std::uint8_t toggle = 0;
  std::size_t taken = 0;
  std::optional<Bytes> reply;
  while ((reply = Ask({toggle, 1, 2, 3, 4, 5, 6, 7})) && (*reply)[0] != 0x80) {
    taken += 7;
    toggle ^= 0x10;
    ASSERT_LT(taken, 10000u);
  }
  EXPECT_LE(taken, SdoServer::kBufferBytes);
  EXPECT_GT(taken, SdoServer::kBufferBytes - 7);
}

TEST_F(SdoServerTest, ClientAbortEndsTheTransferSilently) {
  objects_.values[{0x3000, 0}] = std::vector<std::uint8_t>(20, 1);
  Ask({0x40, 0x00, 0x30, 0});
  EXPECT_EQ(Ask({0x80, 0x00, 0x30, 0, 0, 0, 0x04, 0x05}), std::nullopt);
  EXPECT_EQ((*Ask({0x60}))[0], 0x80);
  EXPECT_EQ(objects_.uploads, 0);
}

TEST_F(SdoServerTest, NewTransferReplacesAnUnfinishedOne) {
  Ask({0x21, 0x00, 0x30, 0, 9});
  objects_.values[{0x2000, 2}] = {1, 2};
  EXPECT_EQ((*Ask({0x40, 0x00, 0x20, 2}))[0], 0x4B);
  EXPECT_EQ((*Ask({0x01, 1}))[0], 0x80) << "the download is over";
}

TEST_F(SdoServerTest, ShortFramesAndOtherIdsAreIgnored) {
  server_.OnFrame(Frame{0x610, 7, {0x40, 0x00, 0x20, 1}});
  server_.OnFrame(Frame{0x611, 8, {0x40, 0x00, 0x20, 1}});
  EXPECT_TRUE(replies_.sent.empty());
}

}  // namespace
}  // namespace zro::node
