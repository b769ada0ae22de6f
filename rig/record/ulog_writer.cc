#include "rig/record/ulog_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/check.h"

namespace zrobench::ulog {
namespace {

void Copy(std::uint8_t* to, std::string_view text) { std::memcpy(to, text.data(), text.size()); }

}  // namespace

Result<std::unique_ptr<Writer>> Writer::Create(const std::filesystem::path& path,
                                               std::uint64_t start_us) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (fd < 0) {
    return Fail(Error::Kind::kFile,
                fmt::format("{}: cannot be created: {}", path.string(), std::strerror(errno)));
  }
  std::unique_ptr<Writer> writer(new Writer(path, fd));
  struct stat about {};
  if (::fstat(fd, &about) == 0 && about.st_size > 0) {
    return Fail(Error::Kind::kFile,
                fmt::format("{}: exists already; a record is never overwritten", path.string()));
  }
  // A message larger than a block waits alone.
  writer->buffer_ = std::make_unique<std::uint8_t[]>(kMaxMessageBytes + kMessageHeaderBytes);
  writer->last_sync_ = writer->clock_.now();
  std::memcpy(writer->buffer_.get(), kMagic.data(), kMagic.size());
  std::memcpy(writer->buffer_.get() + kMagic.size(), &start_us, sizeof start_us);
  writer->used_ = kHeaderBytes;
  std::memset(writer->Begin('B', kFlagBitsBytes), 0, kFlagBitsBytes);
  return writer;
}

Writer::~Writer() { static_cast<void>(Close()); }

void Writer::Info(std::string_view key, std::string_view value) {
  const std::string typed = fmt::format("char[{}] {}", value.size(), key);
  ZROBENCH_CHECK(typed.size() <= 255 && typed.size() + value.size() < kMaxMessageBytes);
  std::uint8_t* const body = Begin('I', 1 + typed.size() + value.size());
  body[0] = static_cast<std::uint8_t>(typed.size());
  Copy(body + 1, typed);
  Copy(body + 1 + typed.size(), value);
}

void Writer::Format(std::string_view text) {
  ZROBENCH_CHECK(text.size() <= kMaxMessageBytes);
  Copy(Begin('F', text.size()), text);
}

void Writer::Subscribe(std::uint16_t id, std::string_view name) {
  std::uint8_t* const body = Begin('A', 3 + name.size());
  body[0] = 0;  // multi_id: one instance of each message
  std::memcpy(body + 1, &id, sizeof id);
  Copy(body + 3, name);
}

void Writer::Text(char level, std::uint64_t at_us, std::string_view text) {
  text = text.substr(0, kMaxMessageBytes - 9);
  std::uint8_t* const body = Begin('L', 9 + text.size());
  body[0] = static_cast<std::uint8_t>(level);
  std::memcpy(body + 1, &at_us, sizeof at_us);
  Copy(body + 9, text);
}

void Writer::Sync() {
  std::memcpy(Begin('S', kSyncMagic.size()), kSyncMagic.data(), kSyncMagic.size());
}

void Writer::MakeRoom(std::size_t bytes) {
  ZROBENCH_CHECK(bytes <= kMessageHeaderBytes + kMaxMessageBytes);
  WriteOut();
  limit_ = std::max(kBlockBytes, bytes);
}

void Writer::WriteOut() {
  const std::uint8_t* at = buffer_.get();
  std::size_t left = std::exchange(used_, 0);
  const std::size_t whole = left;
  while (left > 0 && status_ && fd_ >= 0) {
    const std::size_t piece = std::min(left, kBlockBytes);
    const ssize_t n = ::write(fd_, at, piece);
    if (n > 0) {
      at += n;
      left -= static_cast<std::size_t>(n);
    } else if (n < 0 && errno != EINTR) {
      Stop("cannot be written");
    }
  }
  if (!status_ || fd_ < 0) return;
  written_ += whole;
  SyncIfDue();
}

void Writer::SyncIfDue() {
  const Instant now = clock_.now();
  if (now - last_sync_ < std::chrono::seconds(1)) return;
  last_sync_ = now;
  // EINVAL: a pipe or device, which has nothing to sync.
  if (::fdatasync(fd_) != 0 && errno != EINVAL) Stop("cannot be synced to disk");
}

void Writer::Stop(const char* what) {
  status_ = Fail(Error::Kind::kFile,
                 fmt::format("{}: {}: {}", path_.string(), what, std::strerror(errno)));
  // Takes a torn last message away where the file system still lets us; readers stand it anyway.
  if (::ftruncate(fd_, static_cast<off_t>(written_)) != 0) errno = 0;
}

Status Writer::Flush() {
  if (used_ > 0) WriteOut();
  limit_ = kBlockBytes;
  return status_;
}

Status Writer::Close() {
  if (fd_ < 0) return status_;
  static_cast<void>(Flush());
  if (status_ && ::fdatasync(fd_) != 0 && errno != EINVAL) Stop("cannot be synced to disk");
  if (::close(fd_) != 0 && status_) {
    status_ = Fail(Error::Kind::kFile,
                   fmt::format("{}: cannot be closed: {}", path_.string(), std::strerror(errno)));
  }
  fd_ = -1;
  return status_;
}

}  // namespace zrobench::ulog
