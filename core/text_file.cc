#include "core/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace zrobench {
namespace {

tl::unexpected<Error> Unreadable(const std::filesystem::path& path, std::string_view why) {
  return Fail(Error::Kind::kFile, fmt::format("{}: error: cannot read it: {}", path.string(), why));
}

}  // namespace

Result<std::string> ReadTextFile(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return Unreadable(path, "is a directory");
  std::ifstream in(path, std::ios::binary);
  if (!in) return Unreadable(path, std::strerror(errno));
  std::string text;
  std::string block(1 << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    text.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMaxTextFileBytes) return Unreadable(path, "is larger than 16 MiB");
  }
  if (in.bad()) return Unreadable(path, std::strerror(EIO));
  return text;
}

}  // namespace zrobench
