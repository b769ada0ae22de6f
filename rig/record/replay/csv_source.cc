#include "rig/record/replay/csv_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "rig/record/replay/csv_text.h"

namespace zrobench {
namespace {

/// A longer line is no row of a logger: the file is something else.
constexpr std::size_t kMaxLineBytes = 1 << 16;
/// Seconds since 1970 pass; microseconds taken for seconds do not. int64 nanoseconds end at 9.2e9.
constexpr double kMaxTimeS = 8e9;

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

Result<bool> CsvSource::ReadLine() {
  buffer_.resize(kMaxLineBytes);
  in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  if (in_.bad()) return Fail(Error::Kind::kFile, path_.string() + ": cannot be read");
  torn_ = in_.eof();
  const auto bytes = static_cast<std::size_t>(in_.gcount());
  if (torn_ && bytes == 0) return false;
  ++line_;
  if (in_.fail()) {
    return Fail(Error::Kind::kConfig,
                At(fmt::format("a line of more than {} bytes: this is no CSV", kMaxLineBytes)));
  }
  text_ = {buffer_.data(), torn_ ? bytes : bytes - 1};
  if (line_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // byte order mark
  return true;
}

Result<bool> CsvSource::NextLine() {
  for (;;) {
    auto more = ReadLine();
    if (!more || !*more) return more;
    if (!map_.comment.empty() && text_.starts_with(map_.comment)) continue;
    if (TrimField(text_).empty()) continue;
    SplitLine(text_, map_.delimiter, &fields_);
    return true;
  }
}

Status CsvSource::ReadHeader() {
  for (std::size_t i = 0; i < map_.skip_lines; ++i) {
    if (auto more = ReadLine(); !more) return tl::unexpected(more.error());
  }
  std::vector<std::string> names;
  if (map_.header) {
    const auto more = NextLine();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return Fail(Error::Kind::kConfig, At("no header: the file is empty"));
    names.assign(fields_.begin(), fields_.end());
  }
  return Bind(names);
}

Result<std::size_t> CsvSource::IndexOf(const ColumnRef& column,
                                       const std::vector<std::string>& names) const {
  const auto* name = std::get_if<std::string>(&column);
  if (name == nullptr) return std::get<std::size_t>(column);
  const auto found = std::find(names.begin(), names.end(), TrimField(*name));
  if (found != names.end()) {
    if (std::find(found + 1, names.end(), *found) == names.end()) {
      return static_cast<std::size_t>(found - names.begin());
    }
    return Fail(Error::Kind::kConfig,
                At(fmt::format("the header has '{}' twice: give the column's index", *name)));
  }
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
  if (fields_[index].empty()) return std::numeric_limits<double>::quiet_NaN();
  if (const auto value = ParseNumber(fields_[index], map_.decimal)) return *value;
  return Fail(Error::Kind::kConfig,
              At(fmt::format("column {}: '{}' is no finite number", index + 1, fields_[index])));
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
    const double scaled = *value * column.scale + column.offset;
    if (std::isinf(scaled)) {
      return Fail(Error::Kind::kConfig, At(fmt::format("column {}: '{}' is too large once scaled",
                                                       column.index + 1, fields_[column.index])));
    }
    row[column.channel] = scaled;
  }
  if (!has(Channel::kTime) || counted()) return row;
  const double t_s = row[Channel::kTime];
  if (std::isnan(t_s)) return Fail(Error::Kind::kConfig, At("a row without a time"));
  if (std::fabs(t_s) <= kMaxTimeS) return row;
  return Fail(Error::Kind::kConfig, At(fmt::format("a time of {} s: is its unit right?", t_s)));
}

bool CsvSource::counted() const {
  return map_.sample_hz > 0 && std::none_of(columns_.begin(), columns_.end(), [](const Bound& c) {
           return c.channel == Channel::kTime;
         });
}

Status CsvSource::Clock(Row& row) {
  double& t_s = row[Channel::kTime];
  if (counted()) t_s = static_cast<double>(rows_) / map_.sample_hz;
  if (rows_ > 0 && t_s < last_t_s_) {
    return Fail(Error::Kind::kConfig,
                At(fmt::format("time goes backwards: {} s after {} s", t_s, last_t_s_)));
  }
  last_t_s_ = t_s;
  ++rows_;
  return {};
}

Result<std::optional<Row>> CsvSource::Next() {
  for (;;) {
    const auto more = NextLine();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return std::optional<Row>();
    const auto passes = Passes();
    if (passes && !*passes) continue;
    auto row = passes ? ParseRow() : Result<Row>(tl::unexpected(passes.error()));
    const bool readable = row.has_value();
    if (readable) {
      if (const Status clocked = Clock(*row); !clocked) row = tl::unexpected(clocked.error());
    }
    if (row) return std::optional<Row>(*row);
    // One wild time would take all rows behind it along: that is for people to look at.
    if (!torn_ && (readable || !map_.skip_bad_rows)) return tl::unexpected(row.error());
    ++skipped_rows_;
  }
}

}  // namespace zrobench
