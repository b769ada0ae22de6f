#include "core/toml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/key_names.h"
#include "core/text_file.h"

namespace zrobench {
namespace {

Place PlaceOf(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

std::string TypeName(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

UtcNs DayNs(const toml::date& date) {
  using std::chrono::sys_days;
  const sys_days day = std::chrono::year{date.year} / date.month / date.day;
  return std::chrono::nanoseconds(day.time_since_epoch()).count();
}

UtcNs ToUtc(const toml::date_time& t) {
  using std::chrono::hours, std::chrono::minutes, std::chrono::seconds, std::chrono::nanoseconds;
  nanoseconds ns{DayNs(t.date)};
  ns += hours{t.time.hour} + minutes{t.time.minute} + seconds{t.time.second};
  ns += nanoseconds{t.time.nanosecond};
  if (t.offset) ns -= minutes{t.offset->minutes};
  return ns.count();
}

std::string OutOfRange(std::string_view key, double value, const Range& range) {
  const auto reason = [](const std::string& text) {
    return text.empty() ? std::string() : fmt::format(" ({})", text);
  };
  if (value > range.high) {
    return fmt::format("{} = {} is above {}{}", key, value, range.high, reason(range.high_reason));
  }
  return fmt::format("{} = {} {} {}{}", key, value,
                     range.above_low ? "must be greater than" : "is below", range.low,
                     reason(range.low_reason));
}

/// Where a dotted key has more parts than any file of ours; the parser would follow them down its
/// own stack (it bounds the depth of arrays, not that of keys).
std::optional<Place> FindEndlessKey(std::string_view text) {
  constexpr int kMostDots = 100;
  Place at{1, 0};
  int dots = 0;
  for (const char c : text) {
    ++at.column;
    if (c == '.' && ++dots > kMostDots) return at;
    if (std::string_view("=,\"'{}#\n").find(c) != std::string_view::npos) dots = 0;
    if (c == '\n') at = {at.line + 1, 0};
  }
  return std::nullopt;
}

}  // namespace

Place PlaceOf(const toml::node& node) { return PlaceOf(node.source().begin); }
Place PlaceOf(const toml::key& key) { return PlaceOf(key.source().begin); }

Result<TomlFile> ReadToml(const std::filesystem::path& path) {
  auto text = ReadTextFile(path);
  if (!text) return tl::unexpected(text.error());
  TomlFile file{std::move(*text), {}};
  const std::string name = path.string();
  if (const auto endless = FindEndlessKey(file.text)) {
    Diagnostics diagnostics(name);
    diagnostics.Add(*endless, "a key of more than a hundred parts");
    return tl::unexpected(diagnostics.error());
  }
  try {
    file.root = toml::parse(file.text, std::string_view(name));
  } catch (const toml::parse_error& broken) {
    Diagnostics diagnostics(name);
    diagnostics.Add(PlaceOf(broken.source().begin), std::string(broken.description()));
    return tl::unexpected(diagnostics.error());
  }
  return file;
}

std::optional<UtcNs> UtcOf(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    if (text->get().find('\n') != std::string::npos) return std::nullopt;
    try {  // The text of a date is TOML's own notation for one.
      const toml::table parsed = toml::parse("date = " + text->get());
      const toml::node& date = *parsed.get("date");
      return date.is_string() ? std::nullopt : UtcOf(date);
    } catch (const toml::parse_error&) {
      return std::nullopt;
    }
  }
  // int64 nanoseconds end in 2262; the board's dates begin in 1984.
  const auto in_range = [](const toml::date& d) { return d.year >= 1970 && d.year <= 2200; };
  if (const auto* date = node.as_date(); date && in_range(date->get())) return DayNs(date->get());
  if (const auto* t = node.as_date_time(); t && in_range(t->get().date)) return ToUtc(t->get());
  return std::nullopt;
}

Place TableReader::place() const { return table_ ? PlaceOf(*table_) : Place{}; }

Place TableReader::PlaceOfKey(std::string_view key) const {
  const toml::node* node = table_ ? table_->get(key) : nullptr;
  return node ? PlaceOf(*node) : place();
}

const toml::node* TableReader::Find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return table_ ? table_->get(key) : nullptr;
}

bool TableReader::Has(std::string_view key) { return Find(key) != nullptr; }

void TableReader::Complain(std::string_view key, std::string message) {
  diagnostics_->Add(PlaceOfKey(key), std::move(message));
}

bool TableReader::WrongType(const toml::node& node, std::string_view key, std::string_view wanted) {
  diagnostics_->Add(PlaceOf(node),
                    fmt::format("{} must be {}, not {}", key, wanted, TypeName(node)));
  return false;
}

bool TableReader::NumberOf(const toml::node& node, std::string_view key, const Range& range,
                           double* out) {
  if (!node.is_number()) return WrongType(node, key, "a number");
  // node.value<double>() gives nothing for integers beyond 2^53.
  const double value = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                         : node.as_floating_point()->get();
  if (!std::isfinite(value)) {
    diagnostics_->Add(PlaceOf(node), fmt::format("{} must be a finite number", key));
    return false;
  }
  const bool too_low = range.above_low ? value <= range.low : value < range.low;
  if (too_low || value > range.high) {
    diagnostics_->Add(PlaceOf(node), OutOfRange(key, value, range));
    return false;
  }
  *out = value;
  return true;
}

bool TableReader::Number(std::string_view key, double* out, const Range& range) {
  const toml::node* node = Find(key);
  return node && NumberOf(*node, key, range, out);
}

bool TableReader::Count(std::string_view key, std::size_t* out, const Range& range) {
  double value = 0;
  if (!Number(key, &value, range)) return false;
  if (value != std::floor(value)) {
    Complain(key, fmt::format("{} must be a whole number", key));
    return false;
  }
  *out = static_cast<std::size_t>(value);
  return true;
}

bool TableReader::Flag(std::string_view key, bool* out) {
  const toml::node* node = Find(key);
  if (!node) return false;
  if (!node->is_boolean()) return WrongType(*node, key, "true or false");
  *out = node->as_boolean()->get();
  return true;
}

bool TableReader::Text(std::string_view key, std::string* out) {
  const toml::node* node = Find(key);
  if (!node) return false;
  if (!node->is_string()) return WrongType(*node, key, "a text");
  *out = node->as_string()->get();
  return true;
}

bool TableReader::Character(std::string_view key, char* out) {
  std::string text;
  if (!Text(key, &text)) return false;
  if (text.size() != 1) {
    Complain(key, fmt::format("{} must be one character", key));
    return false;
  }
  *out = text.front();
  return true;
}

bool TableReader::Choice(std::string_view key, std::string* out,
                         const std::vector<std::string>& allowed) {
  std::string text;
  if (!Text(key, &text)) return false;
  if (std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
    const std::string nearest = NearestName(text, allowed);
    Complain(key, fmt::format("{} = \"{}\" is not one of {}{}", key, text, fmt::join(allowed, ", "),
                              nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
    return false;
  }
  *out = text;
  return true;
}

bool TableReader::Numbers(std::string_view key, std::vector<double>* out, const Range& range,
                          std::size_t min_size, std::size_t max_size) {
  const toml::node* node = Find(key);
  if (!node) return false;
  if (!node->is_array()) return WrongType(*node, key, "an array of numbers");
  const toml::array& array = *node->as_array();
  if (array.size() < min_size || array.size() > max_size) {
    const std::string wanted = min_size == max_size ? fmt::format("{}", min_size)
                                                    : fmt::format("{} to {}", min_size, max_size);
    Complain(key, fmt::format("{} must hold {} numbers, not {}", key, wanted, array.size()));
    return false;
  }
  std::vector<double> values(array.size());
  bool good = true;
  for (std::size_t i = 0; i < array.size(); ++i) {
    good &= NumberOf(array[i], fmt::format("{}[{}]", key, i), range, &values[i]);
  }
  if (good) *out = std::move(values);
  return good;
}

bool TableReader::Texts(std::string_view key, std::vector<std::string>* out) {
  const toml::node* node = Find(key);
  if (!node) return false;
  if (!node->is_array()) return WrongType(*node, key, "an array of texts");
  std::vector<std::string> texts;
  bool good = true;
  for (const toml::node& element : *node->as_array()) {
    const auto* text = element.as_string();
    good &= text != nullptr || WrongType(element, key, "an array of texts");
    if (text) texts.push_back(text->get());
  }
  if (good) *out = std::move(texts);
  return good;
}

bool TableReader::Date(std::string_view key, UtcNs* out) {
  const toml::node* node = Find(key);
  if (!node) return false;
  const std::optional<UtcNs> utc = UtcOf(*node);
  if (!utc) {
    Complain(key, fmt::format("{} must be an ISO date between 1970 and 2200, as in "
                              "2026-01-01 or 2026-01-01T08:00:00Z",
                              key));
    return false;
  }
  *out = *utc;
  return true;
}

TableReader TableReader::Table(std::string_view key) {
  const toml::node* node = Find(key);
  if (node && !node->is_table()) WrongType(*node, key, "a table");
  return {node ? node->as_table() : nullptr, std::string(key), diagnostics_};
}

std::vector<TableReader> TableReader::Tables(std::string_view key) {
  const toml::node* node = Find(key);
  std::vector<TableReader> readers;
  if (!node) return readers;
  if (!node->is_array()) {
    WrongType(*node, key, "an array of tables");
    return readers;
  }
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_table()) WrongType(element, key, "an array of tables");
    if (element.is_table())
      readers.emplace_back(element.as_table(), std::string(key), diagnostics_);
  }
  return readers;
}

void TableReader::Require(std::initializer_list<std::string_view> keys) {
  for (std::string_view key : keys) {
    if (Find(key)) continue;
    diagnostics_->Add(place(), fmt::format("'{}' is missing in {}", key, name_));
  }
}

void TableReader::RefuseOtherKeys() {
  for (const toml::key* key : keys()) {
    if (std::find(known_.begin(), known_.end(), key->str()) != known_.end()) continue;
    diagnostics_->Add(PlaceOf(*key), fmt::format("'{}' is not a key of {}; {}", key->str(), name_,
                                                 SuggestKey(key->str(), known_)));
  }
}

std::vector<const toml::key*> TableReader::keys() const {
  std::vector<const toml::key*> keys;
  if (!table_) return keys;
  for (const auto& [key, value] : *table_) keys.push_back(&key);
  std::sort(keys.begin(), keys.end(), [](const toml::key* a, const toml::key* b) {
    return a->source().begin < b->source().begin;
  });
  return keys;
}

}  // namespace zrobench
