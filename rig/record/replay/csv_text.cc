#include "rig/record/replay/csv_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace zrobench {
namespace {

constexpr std::string_view kBlanks = " \t\r";

/// Where the field at the start of `rest` ends: at a delimiter outside quotes, or at the end.
std::size_t FieldEnd(std::string_view rest, char delimiter) {
  const std::size_t first = rest.find_first_not_of(' ');
  if (first == std::string_view::npos || rest[first] != '"') {
    return std::min(rest.find(delimiter), rest.size());
  }
  bool quoted = false;
  for (std::size_t i = first; i < rest.size(); ++i) {
    if (rest[i] == '"') quoted = !quoted;  // a doubled quote leaves and comes back
    if (rest[i] == delimiter && !quoted) return i;
  }
  return rest.size();
}

void SplitAtBlanks(std::string_view rest, std::vector<std::string_view>* fields) {
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    if (rest.empty()) return;
    const std::size_t end = std::min(rest.find_first_of(kBlanks), rest.size());
    fields->push_back(TrimField(rest.substr(0, end)));
    rest.remove_prefix(end);
  }
}

}  // namespace

std::string_view TrimField(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return text;
}

void SplitLine(std::string_view line, char delimiter, std::vector<std::string_view>* fields) {
  fields->clear();
  if (delimiter == ' ') return SplitAtBlanks(line, fields);
  for (;;) {
    const std::size_t end = FieldEnd(line, delimiter);
    fields->push_back(TrimField(line.substr(0, end)));
    if (end == line.size()) return;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> ParseNumber(std::string_view field, char decimal) {
  if (field.starts_with('+') && !field.starts_with("+-")) field.remove_prefix(1);
  std::array<char, 64> copy;
  if (decimal != '.') {
    // A point beside a decimal comma groups thousands: reading it as a decimal sign is off by 1000.
    if (field.size() > copy.size() || field.find('.') != std::string_view::npos) {
      return std::nullopt;
    }
    std::replace_copy(field.begin(), field.end(), copy.begin(), decimal, '.');
    field = {copy.data(), field.size()};
  }
  double value = 0;
  const char* const end = field.data() + field.size();
  const auto parsed = std::from_chars(field.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace zrobench
