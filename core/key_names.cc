#include "core/key_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace zrobench {
namespace {

struct Unit {
  std::string_view suffix;
  std::string_view quantity;
};
// What people write instead of our units, beside ours. The longest suffix that fits counts.
constexpr Unit kUnits[] = {
    {"degc", "temperature"},
    {"c", "temperature"},
    {"k", "temperature"},
    {"degf", "temperature"},
    {"s", "time"},
    {"sec", "time"},
    {"ms", "time"},
    {"us", "time"},
    {"min", "time"},
    {"h", "time"},
    {"days", "time"},
    {"hz", "frequency"},
    {"khz", "frequency"},
    {"mhz", "frequency"},
    {"v", "voltage"},
    {"mv", "voltage"},
    {"vpp", "voltage"},
    {"vrms", "voltage"},
    {"spl_db", "sound pressure"},
    {"spl_dba", "sound pressure"},
    {"db", "sound pressure"},
    {"db_spl", "sound pressure"},
    {"pa", "sound pressure"},
    {"dps", "rate"},
    {"mdps", "rate"},
    {"rad_per_s", "rate"},
    {"dph", "rate"},
    {"g", "acceleration"},
    {"mg", "acceleration"},
    {"mps2", "acceleration"},
    {"w", "power"},
    {"mw", "power"},
    {"pct", "share"},
    {"percent", "share"},
    {"degc_per_min", "temperature slope"},
    {"degc_per_s", "temperature slope"},
    {"k_per_min", "temperature slope"},
    {"k_per_s", "temperature slope"},
    {"pct_per_k", "gain"},
    {"pct_per_k_s", "integral gain"},
    {"j_per_k", "heat capacity"},
    {"w_per_k", "conductance"},
    {"mw_per_k", "conductance"},
    {"dps_per_rthz", "rate noise"},
    {"mdps_per_rthz", "rate noise"},
    {"g_per_rthz", "acceleration noise"},
    {"ug_per_rthz", "acceleration noise"},
};

struct Parts {
  std::string_view stem;
  const Unit* unit = nullptr;
};

bool EndsInUnit(std::string_view key, std::string_view suffix) {
  if (!key.ends_with(suffix)) return false;
  return key.size() == suffix.size() || key[key.size() - suffix.size() - 1] == '_';
}

Parts SplitUnit(std::string_view key) {
  Parts parts{key, nullptr};
  for (const Unit& unit : kUnits) {
    if (!EndsInUnit(key, unit.suffix)) continue;
    if (parts.unit && parts.unit->suffix.size() >= unit.suffix.size()) continue;
    parts.unit = &unit;
  }
  if (!parts.unit) return parts;
  const std::size_t cut = key.size() - parts.unit->suffix.size();
  parts.stem = key.substr(0, cut > 0 ? cut - 1 : 0);
  return parts;
}

std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string NearestName(std::string_view name, const std::vector<std::string>& known) {
  std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
  std::string nearest;
  for (const std::string& candidate : known) {
    const std::size_t distance = EditDistance(name, candidate);
    if (distance >= best || distance >= candidate.size()) continue;
    best = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string SuggestKey(std::string_view key, const std::vector<std::string>& known) {
  const Parts wrong = SplitUnit(key);
  for (const std::string& candidate : known) {
    const Parts right = SplitUnit(candidate);
    if (!right.unit || right.stem != wrong.stem) continue;
    if (!wrong.unit) return fmt::format("with its unit it is '{}'", candidate);
    if (wrong.unit->quantity == right.unit->quantity) {
      return fmt::format("wrong unit, write it in {} as '{}'", right.unit->suffix, candidate);
    }
  }
  const std::string nearest = NearestName(key, known);
  if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
  if (known.empty()) return "it takes no keys";
  return fmt::format("known: {}", fmt::join(known, ", "));
}

}  // namespace zrobench
