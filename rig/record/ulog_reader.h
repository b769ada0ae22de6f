#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/result.h"
#include "rig/record/ulog.h"

namespace zrobench::ulog {

/// One message as it lies in the file. The bytes are valid until the next call of Next().
struct Message {
  char type = 0;
  std::span<const std::uint8_t> body;
};

/// How a file ended.
struct End {
  bool whole = true;              ///< the last message was complete and nothing was wrong
  std::uint64_t whole_bytes = 0;  ///< up to here every message is good
  std::string message;            ///< what was wrong; empty when `whole`
};

/// Gives the whole messages of a file in order, with memory that does not grow with its size.
/// A file cut at any byte gives every message in front of the cut; garbage ends the reading.
/// Reading on after the end of a growing file is allowed: Next() then looks for more.
class Reader {
 public:
  /// kFile when it cannot be opened or is no ULog of version 0 or 1.
  static Result<Reader> Open(const std::filesystem::path& path);
  ~Reader();
  Reader(Reader&& other) noexcept;
  Reader& operator=(Reader&&) = delete;

  std::uint64_t start_us() const { return start_us_; }
  /// The next whole message; nothing at the end (end() says how).
  std::optional<Message> Next();
  /// The caller found the message just given unbelievable: the file ends in front of it.
  void Reject(std::string why);
  End end() const;

 private:
  Reader(std::filesystem::path path, int fd);
  Status ReadHeader();
  std::size_t available() const { return filled_ - at_; }
  bool Fill(std::size_t bytes) { return available() >= bytes || ReadMore(bytes); }
  bool ReadMore(std::size_t bytes);
  std::nullopt_t Damaged(const char* why);

  std::filesystem::path path_;
  int fd_ = -1;
  std::unique_ptr<std::uint8_t[]> buffer_;
  std::size_t at_ = 0, filled_ = 0;
  std::uint64_t start_us_ = 0;
  std::uint64_t offset_ = 0;        ///< of buffer_[at_] in the file
  std::uint64_t last_message_ = 0;  ///< offset of the message just given
  std::string damage_;              ///< set once: nothing more is read
};

}  // namespace zrobench::ulog
