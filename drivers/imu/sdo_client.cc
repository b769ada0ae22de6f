#include "drivers/imu/sdo_client.h"

#include <fmt/format.h>

#include <algorithm>

#include "corrector/bytes.h"
#include "corrector/node/codec.h"

namespace zrobench {
namespace {

using zro::node::Frame;
using zro::node::SdoAbort;
using zro::node::SdoMsg;

constexpr std::size_t kSegmentBytes = 7;
constexpr std::uint8_t kToggleBit = 0x10;
constexpr std::uint32_t kMaxUploadBytes = 1 << 20;  // beyond any object of this protocol

bool IsSegment(const Frame& request) {
  const int specifier = request.data[0] >> 5;  // 0: download segment, 3: upload segment
  return specifier == 0 || specifier == 3;
}

}  // namespace

const char* SdoAbortText(std::uint32_t code) {
  switch (static_cast<SdoAbort>(code)) {
    case SdoAbort::kNone:
      return "no reason given";
    case SdoAbort::kToggle:
      return "toggle bit not alternated";
    case SdoAbort::kTimeout:
      return "protocol timed out";
    case SdoAbort::kBadCommand:
      return "command specifier not valid or unknown";
    case SdoAbort::kOutOfMemory:
      return "out of memory";
    case SdoAbort::kWriteOnly:
      return "object is write-only";
    case SdoAbort::kReadOnly:
      return "object is read-only";
    case SdoAbort::kNoObject:
      return "object does not exist";
    case SdoAbort::kLength:
      return "length does not match the object";
    case SdoAbort::kNoSub:
      return "sub-index does not exist";
    case SdoAbort::kRange:
      return "value out of range";
    case SdoAbort::kCannotStore:
      return "data cannot be stored";
    case SdoAbort::kWrongState:
      return "not in this state of the device (locked?)";
    case SdoAbort::kNoContent:
      return "no data available";
  }
  return "unknown abort code";
}

void SdoClient::OnFrame(const Frame& frame) {
  if (frame.id == SdoMsg::kTxId && frame.dlc == SdoMsg::kDlc) reply_ = frame;
}

std::string SdoClient::Name() const {
  return fmt::format("SDO {} of 0x{:04X}:{}", transfer_.verb, transfer_.index, transfer_.sub);
}

Frame SdoClient::Request(std::uint8_t command, std::uint32_t data) const {
  return Encode(SdoMsg{SdoMsg::kRxId, command, transfer_.index, transfer_.sub, data});
}

// Late answers to an earlier, given-up transfer name another object: they are passed over.
bool SdoClient::Answers(const Frame& request, const Frame& reply) const {
  const bool names_object = reply.data[0] >> 5 == 4 || !IsSegment(request);
  return !names_object ||
         (zro::GetU16(reply.data + 1) == transfer_.index && reply.data[3] == transfer_.sub);
}

Result<Frame> SdoClient::Exchange(const Frame& request) {
  if (Status pumped = pump_(); !pumped) return tl::unexpected(pumped.error());
  reply_.reset();
  if (Status sent = bus_.Send(request); !sent) return tl::unexpected(sent.error());
  const WaitSource* const sources[] = {&bus_};
  while (true) {
    if (Status pumped = pump_(); !pumped) return tl::unexpected(pumped.error());
    if (reply_ && Answers(request, *reply_)) break;
    reply_.reset();
    if (clock_.now() >= transfer_.deadline) {
      return Abort(SdoAbort::kTimeout, Error::Kind::kTimeout,
                   "the board does not answer (powered? right bus and bit rate?)");
    }
    clock_.Wait(transfer_.deadline, sources);
  }
  if (reply_->data[0] >> 5 != 4) return *reply_;
  const std::uint32_t code = zro::GetU32(reply_->data + 4);
  return Fail(Error::Kind::kRefused,
              fmt::format("{}: refused: {} (0x{:08X})", Name(), SdoAbortText(code), code));
}

tl::unexpected<Error> SdoClient::Abort(SdoAbort code, Error::Kind kind, std::string why) {
  // The transfer has failed already; whether the abort gets through changes nothing.
  static_cast<void>(bus_.Send(Request(0x80, static_cast<std::uint32_t>(code))));
  return Fail(kind, fmt::format("{}: {}", Name(), why));
}

tl::unexpected<Error> SdoClient::Unexpected(const Frame& reply) {
  return Abort(SdoAbort::kBadCommand, Error::Kind::kProtocol,
               fmt::format("unexpected answer 0x{:02X}", reply.data[0]));
}

Result<std::vector<std::uint8_t>> SdoClient::Upload(std::uint16_t index, std::uint8_t sub,
                                                    Instant deadline) {
  transfer_ = {index, sub, "upload", deadline};
  const Result<Frame> reply = Exchange(Request(0x40, 0));
  if (!reply) return tl::unexpected(reply.error());
  const std::uint8_t command = reply->data[0];
  if (command >> 5 != 2) return Unexpected(*reply);
  if (command & 2) {
    const int size = command & 1 ? 4 - (command >> 2 & 3) : 4;
    return std::vector<std::uint8_t>(reply->data + 4, reply->data + 4 + size);
  }
  const std::uint32_t size = command & 1 ? zro::GetU32(reply->data + 4) : kMaxUploadBytes;
  if (size > kMaxUploadBytes) {
    return Abort(SdoAbort::kOutOfMemory, Error::Kind::kProtocol,
                 fmt::format("the board announces {} bytes", size));
  }
  Result<std::vector<std::uint8_t>> bytes = UploadSegments(size);
  if (bytes && (command & 1) && bytes->size() != size) {
    return Fail(Error::Kind::kProtocol,
                fmt::format("{}: {} bytes announced, {} came", Name(), size, bytes->size()));
  }
  return bytes;
}

Result<std::vector<std::uint8_t>> SdoClient::UploadSegments(std::uint32_t size) {
  std::vector<std::uint8_t> bytes;
  for (std::uint8_t toggle = 0;; toggle ^= kToggleBit) {
    const auto request_command = static_cast<std::uint8_t>(0x60 | toggle);
    const Result<Frame> reply = Exchange(Frame{SdoMsg::kRxId, SdoMsg::kDlc, {request_command}});
    if (!reply) return tl::unexpected(reply.error());
    const std::uint8_t command = reply->data[0];
    if (command >> 5 != 0) return Unexpected(*reply);
    if ((command & kToggleBit) != toggle) {
      return Abort(SdoAbort::kToggle, Error::Kind::kProtocol, "toggle bit not alternated");
    }
    const std::size_t n = kSegmentBytes - (command >> 1 & 7);
    if (bytes.size() + n > size) {
      return Abort(SdoAbort::kLength, Error::Kind::kProtocol,
                   fmt::format("more than the {} bytes announced", size));
    }
    bytes.insert(bytes.end(), reply->data + 1, reply->data + 1 + n);
    if (command & 1) return bytes;
  }
}

Status SdoClient::Download(std::uint16_t index, std::uint8_t sub,
                           std::span<const std::uint8_t> bytes, Instant deadline) {
  transfer_ = {index, sub, "download", deadline};
  const bool expedited = !bytes.empty() && bytes.size() <= 4;
  Frame request = Request(0x21, static_cast<std::uint32_t>(bytes.size()));
  if (expedited) {
    request = Request(static_cast<std::uint8_t>(0x23 | (4 - bytes.size()) << 2), 0);
    std::copy(bytes.begin(), bytes.end(), request.data + 4);
  }
  const Result<Frame> reply = Exchange(request);
  if (!reply) return tl::unexpected(reply.error());
  if (reply->data[0] >> 5 != 3) return Unexpected(*reply);
  return expedited ? Status{} : DownloadSegments(bytes);
}

Status SdoClient::DownloadSegments(std::span<const std::uint8_t> bytes) {
  for (std::uint8_t toggle = 0;; toggle ^= kToggleBit) {
    const std::size_t n = std::min(bytes.size(), kSegmentBytes);
    const bool last = n == bytes.size();
    Frame segment{SdoMsg::kRxId, SdoMsg::kDlc, {}};
    segment.data[0] =
        static_cast<std::uint8_t>(toggle | (kSegmentBytes - n) << 1 | (last ? 1u : 0u));
    std::copy_n(bytes.begin(), n, segment.data + 1);
    const Result<Frame> reply = Exchange(segment);
    if (!reply) return tl::unexpected(reply.error());
    if (reply->data[0] >> 5 != 1) return Unexpected(*reply);
    if ((reply->data[0] & kToggleBit) != toggle) {
      return Abort(SdoAbort::kToggle, Error::Kind::kProtocol, "toggle bit not alternated");
    }
    if (last) return {};
    bytes = bytes.subspan(n);
  }
}

}  // namespace zrobench
