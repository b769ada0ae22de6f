#include "rig/record/ulog.h"

#include <charconv>
#include <utility>

namespace zrobench::ulog {
namespace {

constexpr std::pair<std::string_view, std::size_t> kTypes[] = {
    {"int8_t", 1},  {"uint8_t", 1},  {"int16_t", 2}, {"uint16_t", 2},
    {"int32_t", 4}, {"uint32_t", 4}, {"int64_t", 8}, {"uint64_t", 8},
    {"float", 4},   {"double", 8},   {"bool", 1},    {"char", 1}};

/// "int16_t[3] raw_lsb" at `offset`.
std::optional<Field> ParseField(std::string_view text, std::size_t offset) {
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos || space + 1 == text.size()) return std::nullopt;
  std::string_view type = text.substr(0, space);
  Field field;
  field.name = text.substr(space + 1);
  field.offset = offset;
  if (const std::size_t bracket = type.find('['); bracket != std::string_view::npos) {
    const char* const end = type.data() + type.size();
    const auto parsed = std::from_chars(type.data() + bracket + 1, end, field.count);
    if (parsed.ec != std::errc() || parsed.ptr + 1 != end || *parsed.ptr != ']')
      return std::nullopt;
    if (field.count > kMaxMessageBytes) return std::nullopt;
    type = type.substr(0, bracket);
  }
  field.type = type;
  field.bytes = TypeBytes(type) * field.count;
  if (field.bytes == 0) return std::nullopt;
  return field;
}

}  // namespace

std::size_t TypeBytes(std::string_view type) {
  for (const auto& [name, bytes] : kTypes) {
    if (name == type) return bytes;
  }
  return 0;
}

std::optional<Format> ParseFormat(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0) return std::nullopt;
  Format format;
  format.name = text.substr(0, colon);
  text.remove_prefix(colon + 1);
  while (!text.empty()) {
    const std::size_t end = text.find(';');
    auto field = ParseField(text.substr(0, end), format.bytes);
    if (!field) return std::nullopt;
    format.bytes += field->bytes;
    format.fields.push_back(std::move(*field));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  if (format.bytes > kMaxMessageBytes) return std::nullopt;
  return format;
}

}  // namespace zrobench::ulog
