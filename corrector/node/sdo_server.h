#pragma once
// SDO server of CiA 301 (7.2.4.3): expedited and segmented transfers, no block transfer.
// Freestanding; one transfer at a time, in one buffer.
#include <cstddef>
#include <cstdint>

#include "corrector/node/codec.h"
#include "corrector/node/frame.h"
#include "corrector/node/sdo.h"
#include "corrector/table.h"

namespace zro::node {

/// Answers each request at once through the sink. A new initiate drops an unfinished transfer, so
/// no sequence of frames can wedge it. A write takes effect just before its last reply is sent.
class SdoServer {
 public:
  /// Longest value of one transfer: the table's image.
  static constexpr std::size_t kBufferBytes = Table::kMaxImageBytes;

  /// Both are borrowed.
  SdoServer(SdoObjects* objects, FrameSink* sink) : objects_(objects), sink_(sink) {}

  /// A frame to SdoMsg::kRxId; one of another length than 8 is ignored.
  void OnFrame(const Frame& frame);

 private:
  enum class State : std::uint8_t { kIdle, kUploading, kDownloading };

  void InitiateUpload();
  void UploadSegment(std::uint8_t command);
  void InitiateDownload(const SdoMsg& request);
  void DownloadExpedited(const SdoMsg& request, const SdoObject& object);
  void DownloadSegment(const Frame& frame);
  void FinishDownload(std::uint8_t reply_command);
  void Reply(std::uint8_t command, std::uint32_t value);
  void Abort(SdoAbort code);

  SdoObjects* objects_;
  FrameSink* sink_;
  State state_ = State::kIdle;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  std::uint8_t toggle_ = 0;     // 0 or 0x10: what the next segment must carry
  std::size_t announced_ = 0;   // download: size stated at the start; 0 = not stated
  std::size_t fixed_size_ = 0;  // download: size the object demands; 0 = any
  std::size_t size_ = 0;        // bytes in buffer_
  std::size_t sent_ = 0;        // upload: bytes already sent
  std::uint8_t buffer_[kBufferBytes] = {};
};

}  // namespace zro::node
