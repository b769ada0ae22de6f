#include "rig/record/csv_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

namespace zrobench {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return text;
}

}  // namespace

Result<CsvSource> CsvSource::Open(const std::filesystem::path& path, const ImportMap& map) {
  CsvSource source(path, map);
  if (!source.in_) {
    return Fail(Error::Kind::kConfig,
                fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
  }
  if (Status status = source.ReadHeader(); !status) return tl::unexpected(status.error());
  return source;
}

std::string CsvSource::At(std::string_view what) const {
  return fmt::format("{}:{}: error: {}", path_.string(), line_, what);
}

bool CsvSource::NextLine() {
  do {
    if (!std::getline(in_, text_)) return false;
    ++line_;
    torn_ = in_.eof();
  } while ((!map_.comment.empty() && text_.starts_with(map_.comment)) || Trim(text_).empty());
  return true;
}

void CsvSource::Split() {
  fields_.clear();
  std::string_view rest = text_;
  if (map_.delimiter == ' ') {
    while (!(rest = rest.substr(std::min(rest.find_first_not_of(kBlanks), rest.size()))).empty()) {
      const std::size_t end = std::min(rest.find_first_of(kBlanks), rest.size());
      fields_.push_back(Trim(rest.substr(0, end)));
      rest.remove_prefix(end);
    }
    return;
  }
  for (;;) {
    const std::size_t end = rest.find(map_.delimiter);
    fields_.push_back(Trim(rest.substr(0, end)));
    if (end == std::string_view::npos) return;
    rest.remove_prefix(end + 1);
  }
}

Status CsvSource::ReadHeader() {
  for (std::size_t i = 0; i < map_.skip_lines; ++i) {
    if (std::getline(in_, text_)) ++line_;
  }
  std::vector<std::string> names;
  if (map_.header) {
    if (!NextLine()) return Fail(Error::Kind::kConfig, At("no header: the file is empty"));
    if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);  // byte order mark
    Split();
    names.assign(fields_.begin(), fields_.end());
  }
  return Bind(names);
}

Result<std::size_t> CsvSource::IndexOf(const ColumnRef& column,
                                       const std::vector<std::string>& names) const {
  const auto* name = std::get_if<std::string>(&column);
  if (name == nullptr) return std::get<std::size_t>(column);
  const auto found = std::find(names.begin(), names.end(), Trim(*name));
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  return Fail(Error::Kind::kConfig,
              At(fmt::format("no column '{}' among {} (delimiter '{}'): is the delimiter right?",
                             *name, names.size(), map_.delimiter)));
}

Status CsvSource::Bind(const std::vector<std::string>& names) {
  auto columns = map_.columns;
  if (columns.empty()) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (const auto channel = ChannelNamed(names[i])) columns.push_back({*channel, i, 1, 0});
    }
    if (columns.empty()) {
      return Fail(Error::Kind::kConfig,
                  At(fmt::format("no canonical column (t_s, gyro_x_dps, ...) among {} (delimiter "
                                 "'{}'); a foreign file needs an import map",
                                 names.size(), map_.delimiter)));
    }
  }
  for (const MappedColumn& mapped : columns) {
    const auto index = IndexOf(mapped.column, names);
    if (!index) return tl::unexpected(index.error());
    columns_.push_back({mapped.channel, *index, mapped.scale, mapped.offset});
    if (std::exchange(present_[Index(mapped.channel)], true)) {
      return Fail(Error::Kind::kConfig,
                  At(fmt::format("column {} twice", kChannelNames[Index(mapped.channel)])));
    }
  }
  for (const RowFilter& filter : map_.filters) {
    const auto index = IndexOf(filter.column, names);
    if (!index) return tl::unexpected(index.error());
    filters_.push_back({*index, filter});
  }
  if (!has(Channel::kTime) && map_.sample_hz > 0) present_[Index(Channel::kTime)] = true;
  return {};
}

Result<double> CsvSource::Number(std::size_t index) const {
  if (index >= fields_.size()) {
    return Fail(Error::Kind::kConfig, At(fmt::format("the row has {} fields, column {} is wanted",
                                                     fields_.size(), index + 1)));
  }
  std::string_view field = fields_[index];
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (field.front() == '+') field.remove_prefix(1);
  std::array<char, 64> copy;
  if (map_.decimal != '.' && field.size() <= copy.size()) {
    std::replace_copy(field.begin(), field.end(), copy.begin(), map_.decimal, '.');
    field = {copy.data(), field.size()};
  }
  double value = 0;
  const auto parsed = std::from_chars(field.data(), field.data() + field.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != field.data() + field.size() ||
      !std::isfinite(value)) {
    return Fail(Error::Kind::kConfig,
                At(fmt::format("column {}: '{}' is no finite number", index + 1, fields_[index])));
  }
  return value;
}

Result<bool> CsvSource::Passes() const {
  for (const auto& [index, filter] : filters_) {
    if (filter.equals && (index >= fields_.size() || fields_[index] != *filter.equals))
      return false;
    if (!filter.at_least && !filter.at_most) continue;
    const auto value = Number(index);
    if (!value) return tl::unexpected(value.error());
    if (filter.at_least && !(*value >= *filter.at_least)) return false;
    if (filter.at_most && !(*value <= *filter.at_most)) return false;
  }
  return true;
}

Result<Row> CsvSource::ParseRow() const {
  Row row;
  for (const Bound& column : columns_) {
    const auto value = Number(column.index);
    if (!value) return tl::unexpected(value.error());
    row[column.channel] = *value * column.scale + column.offset;
  }
  return row;
}

Status CsvSource::Clock(Row& row) {
  double& t_s = row[Channel::kTime];
  const bool counted = std::none_of(columns_.begin(), columns_.end(), [](const Bound& column) {
    return column.channel == Channel::kTime;
  });
  if (counted && map_.sample_hz > 0) t_s = static_cast<double>(rows_) / map_.sample_hz;
  if (has(Channel::kTime)) {
    if (std::isnan(t_s)) return Fail(Error::Kind::kConfig, At("a row without a time"));
    if (rows_ > 0 && t_s < last_t_s_) {
      return Fail(Error::Kind::kConfig,
                  At(fmt::format("time goes backwards: {} s after {} s", t_s, last_t_s_)));
    }
    last_t_s_ = t_s;
  }
  ++rows_;
  return {};
}

Result<std::optional<Row>> CsvSource::Next() {
  while (NextLine()) {
    Split();
    const auto passes = Passes();
    if (passes && !*passes) continue;
    auto row = passes ? ParseRow() : Result<Row>(tl::unexpected(passes.error()));
    if (!row && (torn_ || map_.skip_bad_rows)) {
      ++skipped_rows_;
      continue;
    }
    if (!row) return tl::unexpected(row.error());
    if (Status status = Clock(*row); !status) return tl::unexpected(status.error());
    return std::optional<Row>(*row);
  }
  if (in_.bad()) return Fail(Error::Kind::kFile, path_.string() + ": cannot be read");
  return std::optional<Row>();
}

}  // namespace zrobench
