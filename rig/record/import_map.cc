#include "rig/record/import_map.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "core/units.h"
#include "rig/record/run_folder.h"

namespace zrobench {
namespace {

struct Unit {
  std::string_view suffix;  ///< of the channel's name
  std::string_view unit;
  double scale, offset;
};
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr Unit kUnits[] = {
    {"_s", "s", 1, 0},
    {"_s", "ms", 1e-3, 0},
    {"_s", "us", 1e-6, 0},
    {"_s", "ns", 1e-9, 0},
    {"_s", "min", 60, 0},
    {"_s", "h", 3600, 0},
    {"_us", "us", 1, 0},
    {"_us", "ms", 1e3, 0},
    {"_us", "s", 1e6, 0},
    {"_dps", "dps", 1, 0},
    {"_dps", "deg/s", 1, 0},
    {"_dps", "mdps", 1e-3, 0},
    {"_dps", "rad/s", kDegPerRad, 0},
    {"_dps", "mrad/s", kDegPerRad * 1e-3, 0},
    {"_g", "g", 1, 0},
    {"_g", "mg", 1e-3, 0},
    {"_g", "m/s2", 1 / kStandardGravityMps2, 0},
    {"_degc", "degC", 1, 0},
    {"_degc", "mdegC", 1e-3, 0},
    {"_degc", "K", 1, -kKelvinOffset},
    {"_degc", "degF", 5.0 / 9.0, -160.0 / 9.0},
    {"_pct", "%", 1, 0},
    {"_pct", "1", 100, 0},
    {"_v", "V", 1, 0},
    {"_v", "mV", 1e-3, 0},
    {"_hz", "Hz", 1, 0},
    {"_hz", "kHz", 1e3, 0},
};

/// Reads one file's tables; collects every complaint with its place.
class MapReader {
 public:
  explicit MapReader(std::string file) : file_(std::move(file)) {}

  ImportMap Read(const toml::table& root) {
    Allow(root, {"schema", "name", "about", "csv", "keep", "channel"});
    if (Get<std::int64_t>(root, "schema", 0) != 1) Complain(root, "schema = 1 expected");
    map_.name = Get<std::string>(root, "name", "");
    if (const auto* csv = Table(root, "csv")) ReadCsv(*csv);
    if (const auto* node = root.get("keep")) ReadFilters(*node);
    if (const auto* channels = Table(root, "channel")) ReadChannels(*channels);
    if (map_.columns.empty()) Complain(root, "[channel] names no column");
    return std::move(map_);
  }
  const std::string& errors() const { return errors_; }

 private:
  void Complain(const toml::node& at, std::string_view what) {
    if (!errors_.empty()) errors_ += '\n';
    errors_ += fmt::format("{}:{}:{}: error: {}", file_, at.source().begin.line,
                           at.source().begin.column, what);
  }
  void Allow(const toml::table& table, std::initializer_list<std::string_view> keys) {
    for (const auto& [key, value] : table) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
        Complain(value, fmt::format("unknown key '{}'", key.str()));
      }
    }
  }
  const toml::table* Table(const toml::table& table, std::string_view key) {
    const auto* node = table.get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) Complain(*node, fmt::format("'{}' must be a table", key));
    return node->as_table();
  }
  template <typename T>
  std::optional<T> Find(const toml::table& table, std::string_view key) {
    const auto* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value<T>();
    if (!value) Complain(*node, fmt::format("'{}' has the wrong type", key));
    return value;
  }
  template <typename T>
  T Get(const toml::table& table, std::string_view key, T otherwise) {
    return Find<T>(table, key).value_or(std::move(otherwise));
  }
  char Character(const toml::table& table, std::string_view key, char otherwise) {
    const auto text = Find<std::string>(table, key);
    if (!text) return otherwise;
    if (text->size() == 1) return text->front();
    Complain(*table.get(key), fmt::format("'{}' must be one character", key));
    return otherwise;
  }

  void ReadCsv(const toml::table& csv) {
    Allow(csv,
          {"delimiter", "decimal", "header", "skip_lines", "comment", "sample_hz", "bad_rows"});
    map_.delimiter = Character(csv, "delimiter", ',');
    map_.decimal = Character(csv, "decimal", '.');
    if (map_.decimal == map_.delimiter) Complain(csv, "delimiter and decimal sign are the same");
    map_.header = Get<bool>(csv, "header", true);
    const auto skip = Get<std::int64_t>(csv, "skip_lines", 0);
    if (skip < 0) Complain(csv, "'skip_lines' must not be negative");
    map_.skip_lines = static_cast<std::size_t>(std::max<std::int64_t>(skip, 0));
    map_.comment = Get<std::string>(csv, "comment", "");
    map_.sample_hz = Get<double>(csv, "sample_hz", 0);
    if (!(map_.sample_hz >= 0)) Complain(csv, "'sample_hz' must be positive");
    const auto bad_rows = Get<std::string>(csv, "bad_rows", "error");
    if (bad_rows != "error" && bad_rows != "skip") {
      Complain(csv, "'bad_rows' must be \"error\" or \"skip\"");
    }
    map_.skip_bad_rows = bad_rows == "skip";
  }

  ColumnRef Column(const toml::table& table) {
    const auto* node = table.get("column");
    if (node == nullptr) {
      Complain(table, "'column' is missing: a header's name or an index from 0");
    } else if (const auto name = node->value_exact<std::string>()) {
      if (!map_.header) Complain(*node, "a column's name needs a header; give its index from 0");
      return *name;
    } else if (const auto index = node->value_exact<std::int64_t>(); index && *index >= 0) {
      return static_cast<std::size_t>(*index);
    } else {
      Complain(*node, "'column' must be a header's name or an index from 0");
    }
    return std::size_t{0};
  }

  void ReadFilters(const toml::node& node) {
    const auto* filters = node.as_array();
    if (filters == nullptr || !filters->is_array_of_tables()) {
      return Complain(node, "'keep' must be [[keep]] tables");
    }
    for (const auto& element : *filters) {
      const auto& table = *element.as_table();
      Allow(table, {"column", "equals", "at_least", "at_most"});
      RowFilter filter{Column(table), Find<std::string>(table, "equals"),
                       Find<double>(table, "at_least"), Find<double>(table, "at_most")};
      if (!filter.equals && !filter.at_least && !filter.at_most) {
        Complain(table, "[[keep]] needs 'equals', 'at_least' or 'at_most'");
      }
      map_.filters.push_back(std::move(filter));
    }
  }

  void ReadChannels(const toml::table& channels) {
    for (const auto& [key, node] : channels) {
      const auto channel = ChannelNamed(key.str());
      if (!channel) {
        Complain(node, fmt::format("unknown channel '{}'", key.str()));
      } else if (!node.is_table()) {
        Complain(node, fmt::format("channel '{}' must be a table with 'column'", key.str()));
      } else {
        ReadChannel(*channel, *node.as_table());
      }
    }
  }

  void ReadChannel(Channel channel, const toml::table& table) {
    Allow(table, {"column", "scale", "offset", "unit"});
    MappedColumn mapped{channel, Column(table), Get<double>(table, "scale", 1),
                        Get<double>(table, "offset", 0)};
    if (const auto unit = Find<std::string>(table, "unit")) {
      const auto conversion = ConvertUnit(*unit, channel);
      if (!conversion) {
        Complain(*table.get("unit"),
                 fmt::format("'{}' is no unit of {}", *unit, kChannelNames[Index(channel)]));
      } else {
        mapped.scale *= conversion->scale;
        mapped.offset = mapped.offset * conversion->scale + conversion->offset;
      }
    }
    map_.columns.push_back(std::move(mapped));
  }

  std::string file_;
  std::string errors_;
  ImportMap map_;
};

}  // namespace

std::string ToText(const ColumnRef& column) {
  if (const auto* name = std::get_if<std::string>(&column)) return "'" + *name + "'";
  return fmt::format("{} (counted from 0)", std::get<std::size_t>(column));
}

std::optional<UnitConversion> ConvertUnit(std::string_view unit, Channel channel) {
  const std::string_view name = kChannelNames[Index(channel)];
  for (const Unit& known : kUnits) {
    if (known.unit == unit && name.ends_with(known.suffix)) {
      return UnitConversion{known.scale, known.offset};
    }
  }
  return std::nullopt;
}

Result<ImportMap> LoadImportMap(const std::filesystem::path& path) {
  const auto text = ReadFile(path);
  if (!text) return Fail(Error::Kind::kConfig, text.error().message);
  const std::string file = path.string();
  try {
    const toml::table root = toml::parse(std::string_view(*text), std::string_view(file));
    MapReader reader(file);
    ImportMap map = reader.Read(root);
    if (!reader.errors().empty()) return Fail(Error::Kind::kConfig, reader.errors());
    return map;
  } catch (const toml::parse_error& error) {
    return Fail(Error::Kind::kConfig,
                fmt::format("{}:{}:{}: error: {}", file, error.source().begin.line,
                            error.source().begin.column, error.description()));
  }
}

}  // namespace zrobench
