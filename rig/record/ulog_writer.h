#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/clock.h"
#include "core/result.h"
#include "rig/record/ulog.h"

namespace zrobench::ulog {

/// Appends messages to a new file: one write(2) a block of at most 4 KiB, a message never split
/// over two blocks, so that a killed program leaves whole messages. fdatasync at most once a
/// second of real time, and at Close(). The first error sticks and stops all writing: what lies
/// behind a torn message could not be read. Thread-compatible; Flush and Close block on the disk.
class Writer {
 public:
  static constexpr std::size_t kBlockBytes = 4096;

  /// Creates the file and buffers header and flag bits. An existing non-empty file is refused
  /// (kFile): a record is never overwritten.
  static Result<std::unique_ptr<Writer>> Create(const std::filesystem::path& path,
                                                std::uint64_t start_us);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void Info(std::string_view key, std::string_view value);
  void Format(std::string_view text);
  /// Announces that data messages `id` have format `name`.
  void Subscribe(std::uint16_t id, std::string_view name);
  /// Room for one data message of `bytes` (id not counted), to be filled at once by the caller:
  /// valid until the next call of any function. Never null; after an error the bytes go nowhere.
  std::uint8_t* Reserve(std::uint16_t id, std::size_t bytes) {
    std::uint8_t* const body = Begin('D', bytes + 2);
    body[0] = static_cast<std::uint8_t>(id);
    body[1] = static_cast<std::uint8_t>(id >> 8);
    return body + 2;
  }
  /// Logged text, level '0' (emergency) to '7' (debug). Cut to what one message holds.
  void Text(char level, std::uint64_t at_us, std::string_view text);
  /// Sync mark: a reader that starts in the middle finds message boundaries again here.
  void Sync();

  /// Hands all buffered messages to the kernel. kFile with the path when that fails.
  Status Flush();
  /// Flush, fdatasync, close. Further messages go nowhere. Idempotent.
  Status Close();
  const Status& status() const { return status_; }
  /// Bytes handed to the kernel so far: all of them whole messages.
  std::uint64_t written_bytes() const { return written_; }

 private:
  Writer(std::filesystem::path path, int fd) : path_(std::move(path)), fd_(fd) {}
  std::uint8_t* Begin(char type, std::size_t bytes) {
    const std::size_t total = kMessageHeaderBytes + bytes;
    if (used_ + total > limit_) MakeRoom(total);
    std::uint8_t* const at = buffer_.get() + used_;
    at[0] = static_cast<std::uint8_t>(bytes);
    at[1] = static_cast<std::uint8_t>(bytes >> 8);
    at[2] = static_cast<std::uint8_t>(type);
    used_ += total;
    return at + kMessageHeaderBytes;
  }
  void MakeRoom(std::size_t bytes);
  void WriteOut();
  void SyncIfDue();
  void Stop(const char* what);

  std::filesystem::path path_;
  int fd_ = -1;
  Status status_;
  std::uint64_t written_ = 0;
  RealClock clock_;  ///< real time, even on the virtual rig: the disk knows no other
  Instant last_sync_{};
  std::unique_ptr<std::uint8_t[]> buffer_;
  std::size_t used_ = 0;
  std::size_t limit_ = kBlockBytes;  ///< more only while one message larger than a block waits
};

}  // namespace zrobench::ulog
