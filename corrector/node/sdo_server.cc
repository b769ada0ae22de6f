#include "corrector/node/sdo_server.h"

#include <string.h>

#include "corrector/bytes.h"
#include "corrector/node/byte_writer.h"

namespace zro::node {
namespace {

constexpr std::size_t kSegmentBytes = 7;
constexpr std::uint8_t kToggleBit = 0x10;

}  // namespace

void SdoServer::OnFrame(const Frame& frame) {
  SdoMsg request{};
  if (!Decode(frame, &request) || request.id != SdoMsg::kRxId) return;
  const int specifier = request.cmd >> 5;
  if (specifier != 0 && specifier != 3) {  // all but segments name their object
    state_ = State::kIdle;
    index_ = request.index;
    sub_ = request.sub;
  }
  switch (specifier) {
    case 0:
      return DownloadSegment(frame);
    case 1:
      return InitiateDownload(request);
    case 2:
      return InitiateUpload();
    case 3:
      return UploadSegment(request.cmd);
    case 4:
      return;  // the client's abort: no answer
    default:
      return Abort(SdoAbort::kBadCommand);  // block transfer
  }
}

void SdoServer::InitiateUpload() {
  SdoAbort abort = SdoAbort::kNone;
  const SdoObject* object = objects_->Find(index_, sub_, &abort);
  if (object == nullptr) return Abort(abort);
  if (object->access == SdoAccess::kWriteOnly) return Abort(SdoAbort::kWriteOnly);
  abort = objects_->Read(index_, sub_, buffer_, kBufferBytes, &size_);
  if (abort != SdoAbort::kNone) return Abort(abort);
  if (size_ >= 1 && size_ <= 4) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size_; ++i) value |= std::uint32_t{buffer_[i]} << (8 * i);
    Reply(static_cast<std::uint8_t>(0x43u | (4 - size_) << 2), value);
    return objects_->OnUploaded(index_, sub_);
  }
  state_ = State::kUploading;
  toggle_ = 0;
  sent_ = 0;
  Reply(0x41, static_cast<std::uint32_t>(size_));
}

void SdoServer::UploadSegment(std::uint8_t command) {
  if (state_ != State::kUploading) return Abort(SdoAbort::kBadCommand);
  if ((command & kToggleBit) != toggle_) return Abort(SdoAbort::kToggle);
  const std::size_t left = size_ - sent_;
  const std::size_t n = left < kSegmentBytes ? left : kSegmentBytes;
  const bool last = n == left;
  Frame frame{SdoMsg::kTxId, SdoMsg::kDlc, {}};
  frame.data[0] = static_cast<std::uint8_t>(toggle_ | (kSegmentBytes - n) << 1 | (last ? 1u : 0u));
  memcpy(frame.data + 1, buffer_ + sent_, n);
  sent_ += n;
  toggle_ ^= kToggleBit;
  sink_->Send(frame);
  if (!last) return;
  state_ = State::kIdle;
  objects_->OnUploaded(index_, sub_);
}

void SdoServer::InitiateDownload(const SdoMsg& request) {
  SdoAbort abort = SdoAbort::kNone;
  const SdoObject* object = objects_->Find(index_, sub_, &abort);
  if (object == nullptr) return Abort(abort);
  if (object->access == SdoAccess::kReadOnly) return Abort(SdoAbort::kReadOnly);
  if (request.cmd & 2) return DownloadExpedited(request, *object);
  announced_ = request.cmd & 1 ? request.data : 0;
  fixed_size_ = object->size;
  if (announced_ > kBufferBytes) return Abort(SdoAbort::kLength);
  if (announced_ != 0 && fixed_size_ != 0 && announced_ != fixed_size_) {
    return Abort(SdoAbort::kLength);
  }
  state_ = State::kDownloading;
  toggle_ = 0;
  size_ = 0;
  Reply(0x60, 0);
}

void SdoServer::DownloadExpedited(const SdoMsg& request, const SdoObject& object) {
  const bool stated = request.cmd & 1;
  fixed_size_ = object.size;
  announced_ = 0;
  size_ = stated                                ? 4u - (request.cmd >> 2 & 3u)
          : fixed_size_ != 0 && fixed_size_ < 4 ? fixed_size_
                                                : 4;
  ByteWriter(buffer_, kBufferBytes).Put(request.data, 4);
  FinishDownload(0x60);
}

void SdoServer::DownloadSegment(const Frame& frame) {
  if (state_ != State::kDownloading) return Abort(SdoAbort::kBadCommand);
  const std::uint8_t command = frame.data[0];
  if ((command & kToggleBit) != toggle_) return Abort(SdoAbort::kToggle);
  const std::size_t n = kSegmentBytes - (command >> 1 & 7u);
  if (size_ + n > kBufferBytes) return Abort(SdoAbort::kLength);
  memcpy(buffer_ + size_, frame.data + 1, n);
  size_ += n;
  const auto reply = static_cast<std::uint8_t>(0x20 | toggle_);
  toggle_ ^= kToggleBit;
  if (command & 1) return FinishDownload(reply);
  sink_->Send(Frame{SdoMsg::kTxId, SdoMsg::kDlc, {reply}});
}

void SdoServer::FinishDownload(std::uint8_t reply_command) {
  if (announced_ != 0 && size_ != announced_) return Abort(SdoAbort::kLength);
  if (fixed_size_ != 0 && size_ != fixed_size_) return Abort(SdoAbort::kLength);
  const SdoAbort abort = objects_->Write(index_, sub_, buffer_, size_);
  if (abort != SdoAbort::kNone) return Abort(abort);
  state_ = State::kIdle;
  if (reply_command == 0x60) return Reply(reply_command, 0);
  sink_->Send(Frame{SdoMsg::kTxId, SdoMsg::kDlc, {reply_command}});
}

void SdoServer::Reply(std::uint8_t command, std::uint32_t value) {
  sink_->Send(Encode(SdoMsg{SdoMsg::kTxId, command, index_, sub_, value}));
}

void SdoServer::Abort(SdoAbort code) {
  state_ = State::kIdle;
  Reply(0x80, static_cast<std::uint32_t>(code));
}

}  // namespace zro::node
