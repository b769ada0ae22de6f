#include "rig/record/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/text_file.h"
#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

tl::unexpected<Error> FileError(const std::filesystem::path& path, std::string_view what,
                                int code) {
  return Fail(Error::Kind::kFile,
              fmt::format("{}: {}: {}", path.string(), what, std::strerror(code)));
}

/// "2026-01-01T000000Z"
std::string FolderStamp(UtcNs utc) {
  std::string text = UtcText(utc).substr(0, 19);
  std::erase(text, ':');
  return text + 'Z';
}

std::string FileNamePart(std::string_view name) {
  std::string part(name);
  for (char& c : part) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain && c != '_' && c != '-' && c != '.') c = '-';
  }
  return part;
}

Status WriteAll(int fd, const std::filesystem::path& path, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return FileError(path, "cannot be written", errno);
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  if (::fsync(fd) != 0) return FileError(path, "cannot be synced to disk", errno);
  return {};
}

/// A rename is on disk only when its folder is. Some file systems refuse: nothing more can be done.
void SyncFolder(const std::filesystem::path& folder) {
  const int fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  static_cast<void>(::fsync(fd));
  ::close(fd);
}

}  // namespace

Result<RunFolder> RunFolder::Create(const std::filesystem::path& runs, UtcNs epoch,
                                    std::string_view station, std::string_view profile) {
  std::error_code error;
  std::filesystem::create_directories(runs, error);
  if (error) return FileError(runs, "cannot be created", error.value());
  const std::string name =
      fmt::format("{}-{}-{}", FolderStamp(epoch), FileNamePart(station), FileNamePart(profile));
  for (int n = 1;; ++n) {
    const auto path = runs / (n == 1 ? name : fmt::format("{}-{}", name, n));
    if (std::filesystem::create_directory(path, error)) return RunFolder(path);
    // false without an error: the name is taken by a folder; with EEXIST: by something else.
    if (error && error != std::errc::file_exists) {
      return FileError(path, "cannot be created", error.value());
    }
  }
}

Result<RunFolder> RunFolder::Open(const std::filesystem::path& path) {
  RunFolder folder(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(folder.record_path(), error)) {
    return Fail(Error::Kind::kFile,
                fmt::format("{}: is no run folder: it holds no record.ulg", path.string()));
  }
  return folder;
}

Status RunFolder::WriteInputs(const std::string& profile_toml,
                              const std::string& station_toml) const {
  if (Status status = WriteFileAtomically(profile_path(), profile_toml); !status) return status;
  return WriteFileAtomically(station_path(), station_toml);
}

Status RunFolder::WriteManifest(const RunManifest& manifest) const {
  return WriteFileAtomically(run_json_path(), ToJson(manifest));
}

Result<RunManifest> RunFolder::ReadManifest() const {
  const auto text = ReadTextFile(run_json_path());
  if (!text) return tl::unexpected(text.error());
  auto manifest = ManifestFromJson(*text);
  if (!manifest) {
    return Fail(manifest.error().kind, path_.string() + "/" + manifest.error().message);
  }
  return manifest;
}

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view text) {
  const std::filesystem::path temporary = path.string() + ".tmp";
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) return FileError(temporary, "cannot be created", errno);
  Status status = WriteAll(fd, temporary, text);
  if (::close(fd) != 0 && status) status = FileError(temporary, "cannot be closed", errno);
  if (status && ::rename(temporary.c_str(), path.c_str()) != 0) {
    status = FileError(path, "cannot be replaced", errno);
  }
  if (!status) {
    ::unlink(temporary.c_str());
    return status;
  }
  SyncFolder(path.parent_path());
  return {};
}

}  // namespace zrobench
