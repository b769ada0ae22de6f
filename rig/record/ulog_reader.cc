#include "rig/record/ulog_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace zrobench::ulog {
namespace {

// Room for the largest message several times over: memmove of the rest stays rare.
constexpr std::size_t kBufferBytes = 4 * (kMaxMessageBytes + kMessageHeaderBytes);

/// Why a message cannot be one, or nothing.
const char* Implausible(char type, std::span<const std::uint8_t> body) {
  if (type == 'S' && (body.size() != kSyncMagic.size() ||
                      !std::equal(body.begin(), body.end(), kSyncMagic.begin()))) {
    return "is a sync mark without its magic number";
  }
  if ((type == 'D' && body.size() < 2) || (type == 'L' && body.size() < 9) ||
      (type == 'A' && body.size() < 4)) {
    return "is too short for its type";
  }
  return nullptr;
}

}  // namespace

Reader::Reader(std::filesystem::path path, int fd)
    : path_(std::move(path)), fd_(fd), buffer_(new std::uint8_t[kBufferBytes]) {}

Reader::Reader(Reader&& other) noexcept
    : path_(std::move(other.path_)),
      fd_(std::exchange(other.fd_, -1)),
      buffer_(std::move(other.buffer_)),
      at_(other.at_),
      filled_(other.filled_),
      start_us_(other.start_us_),
      offset_(other.offset_),
      last_message_(other.last_message_),
      damage_(std::move(other.damage_)) {}

Reader::~Reader() {
  if (fd_ >= 0) ::close(fd_);
}

Result<Reader> Reader::Open(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    return Fail(Error::Kind::kFile,
                fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
  }
  Reader reader(path, fd);
  if (Status status = reader.ReadHeader(); !status) return tl::unexpected(status.error());
  return reader;
}

Status Reader::ReadHeader() {
  if (!Fill(kHeaderBytes)) {
    return Fail(Error::Kind::kFile, fmt::format("{}: {} bytes are too few for a ULog header",
                                                path_.string(), available()));
  }
  const bool magic = std::equal(kMagic.begin(), kMagic.end() - 1, buffer_.get());
  if (!magic || buffer_[kMagic.size() - 1] > kMagic.back()) {
    return Fail(Error::Kind::kFile,
                fmt::format("{}: is no ULog file of version 0 or 1", path_.string()));
  }
  std::memcpy(&start_us_, buffer_.get() + kMagic.size(), sizeof start_us_);
  at_ += kHeaderBytes;
  offset_ = last_message_ = kHeaderBytes;
  return {};
}

bool Reader::ReadMore(std::size_t bytes) {
  std::memmove(buffer_.get(), buffer_.get() + at_, available());
  filled_ -= std::exchange(at_, 0);
  while (filled_ < bytes) {
    const ssize_t n = ::read(fd_, buffer_.get() + filled_, kBufferBytes - filled_);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      damage_ = fmt::format("{}: cannot be read: {}", path_.string(), std::strerror(errno));
    if (n <= 0) return false;
    filled_ += static_cast<std::size_t>(n);
  }
  return true;
}

std::optional<Message> Reader::Next() {
  if (!damage_.empty() || !Fill(kMessageHeaderBytes)) return std::nullopt;
  const std::size_t size =
      static_cast<std::size_t>(buffer_[at_]) | static_cast<std::size_t>(buffer_[at_ + 1]) << 8;
  const std::size_t total = kMessageHeaderBytes + size;
  const char type = static_cast<char>(buffer_[at_ + 2]);
  // Letters that we do not know may come from later versions; anything else is no ULog.
  if (type < 'A' || type > 'Z') return Damaged("is no message type");
  if (!Fill(total)) return std::nullopt;
  const Message message{type, {buffer_.get() + at_ + kMessageHeaderBytes, size}};
  if (const char* why = Implausible(type, message.body)) return Damaged(why);
  last_message_ = offset_;
  offset_ += total;
  at_ += total;
  return message;
}

std::nullopt_t Reader::Damaged(const char* why) {
  damage_ = fmt::format("{}: byte {}: garbage: 0x{:02x} {}", path_.string(), offset_,
                        buffer_[at_ + 2], why);
  return std::nullopt;
}

void Reader::Reject(std::string why) {
  damage_ = fmt::format("{}: byte {}: garbage: {}", path_.string(), last_message_, why);
  offset_ = last_message_;
}

End Reader::end() const {
  End end{damage_.empty() && available() == 0, offset_, damage_};
  if (damage_.empty() && available() > 0) {
    end.message = fmt::format("{}: cut at byte {}: {} bytes of an unfinished message follow",
                              path_.string(), offset_, available());
  }
  return end;
}

}  // namespace zrobench::ulog
