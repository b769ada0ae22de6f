#pragma once
// Typed, range-checked access to a TOML file: station, profile, import map. Nothing here throws or
// stops at the first fault: what is wrong goes into Diagnostics, the value keeps its default.
#include <toml++/toml.h>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock.h"
#include "core/diagnostics.h"
#include "core/result.h"

namespace zrobench {

/// Allowed values, in the unit that the key's name states. NaN and infinities never are.
struct Range {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  double low = -kNoLimit;
  double high = kNoLimit;
  bool above_low = false;  ///< low itself is not allowed
  std::string low_reason;  ///< whose limit it is, for the message; may be empty
  std::string high_reason;

  static Range Between(double low, double high) { return {low, high, false, "", ""}; }
  static Range AtLeast(double low) { return {low, kNoLimit, false, "", ""}; }
  static Range Positive(double high = kNoLimit) { return {0, high, true, "", ""}; }
  static Range Any() { return {}; }
};

struct TomlFile {
  std::string text;
  toml::table root;
};
/// kFile when it cannot be read; kConfig (file:line:column) when it is not TOML.
Result<TomlFile> ReadToml(const std::filesystem::path& path);

/// Wall time of a TOML date, date-time (UTC where it names no offset) or a text that holds one.
/// Empty when `node` is none of these or lies outside 1970..2200.
std::optional<UtcNs> UtcOf(const toml::node& node);

Place PlaceOf(const toml::node& node);
Place PlaceOf(const toml::key& key);

/// One table of the file. Every key that is asked for counts as known; RefuseOtherKeys() reports
/// the rest. Getters return true when the key is there and good; the value is untouched otherwise.
/// Borrows the table and the diagnostics.
class TableReader {
 public:
  /// `table` may be null: then nothing is present. `name`: as messages call it ("ramp").
  TableReader(const toml::table* table, std::string name, Diagnostics* diagnostics)
      : table_(table), name_(std::move(name)), diagnostics_(diagnostics) {}

  bool present() const { return table_ != nullptr; }
  /// Null when not present.
  const toml::table* table() const { return table_; }
  const std::string& name() const { return name_; }
  bool IsArray(std::string_view key) const {
    const toml::node* node = table_ ? table_->get(key) : nullptr;
    return node && node->is_array();
  }
  Place place() const;
  /// Place of the key's value; of the table when the key is missing.
  Place PlaceOfKey(std::string_view key) const;

  bool Has(std::string_view key);
  bool Number(std::string_view key, double* out, const Range& range);
  /// A whole number; `range` lies within 0..2^53.
  bool Count(std::string_view key, std::size_t* out, const Range& range);
  bool Flag(std::string_view key, bool* out);
  bool Text(std::string_view key, std::string* out);
  /// A text of one byte.
  bool Character(std::string_view key, char* out);
  /// One of `allowed`.
  bool Choice(std::string_view key, std::string* out, const std::vector<std::string>& allowed);
  /// Between `min_size` and `max_size` numbers.
  bool Numbers(std::string_view key, std::vector<double>* out, const Range& range,
               std::size_t min_size, std::size_t max_size);
  bool Texts(std::string_view key, std::vector<std::string>* out);
  bool Date(std::string_view key, UtcNs* out);
  /// A reader over the table under `key`; not present() when missing or not a table (reported).
  TableReader Table(std::string_view key);
  /// Readers over the tables of the array under `key`; empty when missing.
  std::vector<TableReader> Tables(std::string_view key);

  void Require(std::initializer_list<std::string_view> keys);
  void RefuseOtherKeys();
  /// All keys as written, in file order.
  std::vector<const toml::key*> keys() const;

  /// Reports at the value of `key`.
  void Complain(std::string_view key, std::string message);
  Diagnostics* diagnostics() const { return diagnostics_; }

 private:
  const toml::node* Find(std::string_view key);
  bool WrongType(const toml::node& node, std::string_view key, std::string_view wanted);
  bool NumberOf(const toml::node& node, std::string_view key, const Range& range, double* out);

  const toml::table* table_;
  std::string name_;
  Diagnostics* diagnostics_;
  std::vector<std::string> known_;
};

}  // namespace zrobench
