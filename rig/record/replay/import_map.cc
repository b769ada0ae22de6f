#include "rig/record/replay/import_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <utility>

#include "core/toml_reader.h"
#include "core/units.h"

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
    {"_db", "dB", 1, 0},
    {"_hz", "Hz", 1, 0},
    {"_hz", "kHz", 1e3, 0},
};

void ReadCsv(TableReader csv, ImportMap* map) {
  csv.Character("delimiter", &map->delimiter);
  csv.Character("decimal", &map->decimal);
  if (map->decimal != '.' && map->decimal != ',') {
    csv.Complain("decimal", "decimal must be \".\" or \",\"");
  }
  if (map->decimal == map->delimiter) {
    csv.Complain("delimiter", "delimiter and decimal sign are the same");
  }
  csv.Flag("header", &map->header);
  csv.Count("skip_lines", &map->skip_lines, Range::Between(0, 1e6));
  csv.Text("comment", &map->comment);
  csv.Number("sample_hz", &map->sample_hz, Range::Positive(1e6));
  std::string bad_rows = "error";
  csv.Choice("bad_rows", &bad_rows, {"error", "skip"});
  map->skip_bad_rows = bad_rows == "skip";
  csv.RefuseOtherKeys();
}

ColumnRef ReadColumn(TableReader* reader, bool header) {
  reader->Require({"column"});
  if (!reader->Has("column")) return std::size_t{0};
  const toml::node& node = *reader->table()->get("column");
  if (const auto name = node.value_exact<std::string>()) {
    if (!header) {
      reader->Complain("column", "a column's name needs a header; give its index from 0");
    }
    return *name;
  }
  const auto index = node.value_exact<std::int64_t>();
  if (index && *index >= 0) return static_cast<std::size_t>(*index);
  reader->Complain("column", "column must be a header's name or an index from 0");
  return std::size_t{0};
}

std::optional<double> ReadBound(TableReader* reader, std::string_view key) {
  double value = 0;
  return reader->Number(key, &value, Range::Any()) ? std::optional(value) : std::nullopt;
}

void ReadFilter(TableReader reader, ImportMap* map) {
  RowFilter filter{ReadColumn(&reader, map->header), std::nullopt, ReadBound(&reader, "at_least"),
                   ReadBound(&reader, "at_most")};
  if (std::string text; reader.Text("equals", &text)) filter.equals = text;
  reader.RefuseOtherKeys();
  if (!reader.Has("equals") && !reader.Has("at_least") && !reader.Has("at_most")) {
    reader.Complain("", "[[keep]] needs equals, at_least or at_most");
  }
  map->filters.push_back(std::move(filter));
}

std::string UnitsOf(Channel channel) {
  std::vector<std::string_view> units;
  for (const Unit& known : kUnits) {
    if (kChannelNames[Index(channel)].ends_with(known.suffix)) units.push_back(known.unit);
  }
  return units.empty() ? "it takes none" : fmt::format("known: {}", fmt::join(units, ", "));
}

void ReadChannel(TableReader reader, Channel channel, ImportMap* map) {
  MappedColumn mapped{channel, ReadColumn(&reader, map->header)};
  reader.Number("scale", &mapped.scale, Range::Any());
  reader.Number("offset", &mapped.offset, Range::Any());
  if (std::string unit; reader.Text("unit", &unit)) {
    if (const auto conversion = ConvertUnit(unit, channel)) {
      mapped.scale *= conversion->scale;
      mapped.offset = mapped.offset * conversion->scale + conversion->offset;
    } else {
      reader.Complain(
          "unit", fmt::format("'{}' is no unit of {}; {}", unit, reader.name(), UnitsOf(channel)));
    }
  }
  reader.RefuseOtherKeys();
  map->columns.push_back(std::move(mapped));
}

void ReadChannels(TableReader reader, ImportMap* map) {
  for (std::size_t i = 0; i < kChannels; ++i) {
    const TableReader table = reader.Table(kChannelNames[i]);
    if (table.present()) ReadChannel(table, static_cast<Channel>(i), map);
  }
  reader.RefuseOtherKeys();
  if (reader.keys().empty()) reader.Complain("", "[channel] names no column");
}

TableReader Section(TableReader* file, std::string_view key) {
  const TableReader table = file->Table(key);
  return {table.table(), fmt::format("[{}]", key), file->diagnostics()};
}

void ReadMap(TableReader file, ImportMap* map) {
  double schema = 1;
  file.Number("schema", &schema, Range::Between(1, 1));
  file.Text("name", &map->name);
  std::string about;  // for people alone
  file.Text("about", &about);
  file.Require({"schema", "channel"});
  ReadCsv(Section(&file, "csv"), map);
  for (const TableReader& keep : file.Tables("keep")) ReadFilter(keep, map);
  if (const TableReader channels = Section(&file, "channel"); channels.present()) {
    ReadChannels(channels, map);
  }
  file.RefuseOtherKeys();
}

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
  const auto file = ReadToml(path);
  if (!file) return Fail(Error::Kind::kConfig, file.error().message);
  Diagnostics diagnostics(path.string());
  ImportMap map;
  ReadMap(TableReader(&file->root, "an import map", &diagnostics), &map);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.error());
  return map;
}

}  // namespace zrobench
