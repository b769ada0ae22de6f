#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.h"
#include "rig/record/replay/channel.h"

namespace zrobench {

/// A column by its header's name or by its index, counted from 0.
using ColumnRef = std::variant<std::string, std::size_t>;
std::string ToText(const ColumnRef& column);

/// value = (field * scale + offset), from `unit` to the channel's own unit.
struct MappedColumn {
  Channel channel = Channel::kTime;
  ColumnRef column;
  double scale = 1, offset = 0;
};

/// Rows are kept only when the column has this text, or a number in this range.
struct RowFilter {
  ColumnRef column;
  std::optional<std::string> equals;
  std::optional<double> at_least, at_most;
};

/// How a foreign CSV becomes canonical columns (docs/formats.md, "Import map").
struct ImportMap {
  std::string name;
  char delimiter = ',';  ///< ' ' = any run of blanks
  char decimal = '.';
  bool header = true;
  std::size_t skip_lines = 0;         ///< in front of the header
  std::string comment;                ///< lines that begin with it are skipped; empty = none
  double sample_hz = 0;               ///< 0 = from the time column
  bool skip_bad_rows = false;         ///< torn lines are counted and left out instead of refused
  std::vector<MappedColumn> columns;  ///< empty = canonical names in the header
  std::vector<RowFilter> filters;
};

/// Reads MAP.toml. kConfig: all errors at once, one `file:line:column: error: ...` a line.
Result<ImportMap> LoadImportMap(const std::filesystem::path& path);

/// Scale and offset from `unit` to the unit in the channel's name; nothing for a foreign one.
struct UnitConversion {
  double scale = 1, offset = 0;
};
std::optional<UnitConversion> ConvertUnit(std::string_view unit, Channel channel);

}  // namespace zrobench
