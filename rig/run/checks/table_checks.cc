// table_coverage, table_accuracy, table_persists: what the table holds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "corrector/table.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"
#include "rig/run/reference.h"

namespace zrobench {
namespace {

constexpr const char* kAxisName[] = {"x", "y", "z"};

/// The table as the record last showed it; nothing when the record holds none.
std::optional<zro::Table> FinalTable(const Evidence& evidence) {
  if (evidence.tables.empty()) return std::nullopt;
  zro::Table table;
  std::uint32_t generation = 0;
  const auto& image = evidence.tables.back().image;
  if (!table.FromImage(image.data(), image.size(), &generation)) return std::nullopt;
  return table;
}

bool HoldsLearned(const zro::Table& table, double degc, double within_degc) {
  for (int i = 0; i < table.size(); ++i) {
    if (table[i].origin == zro::Origin::kLearned &&
        std::abs(table[i].temp_degc - degc) <= within_degc) {
      return true;
    }
  }
  return false;
}

CheckResult Start(const Expectation& expect, std::string about) {
  CheckResult result;
  result.check = expect.check;
  result.about = std::move(about);
  return result;
}

}  // namespace

CheckResult CheckTableCoverage(const Expectation& expect, const CheckContext& context) {
  const double from = expect.number("from_degc", 0), to = expect.number("to_degc", 0);
  const double step = expect.number("step_degc", 2.5), min_pct = expect.number("min_pct", 100);
  CheckResult result =
      Start(expect, fmt::format("entries every {:g} degC from {:g} to {:g} degC", step, from, to));
  const auto table = FinalTable(context.evidence);
  if (!table) {
    result.reason = "the record holds no readable table";
    return result;
  }
  int bins = 0, held = 0;
  for (double centre = from; centre <= to + 1e-9; centre += step) {
    ++bins;
    held += HoldsLearned(*table, centre, step / 2) ? 1 : 0;
  }
  result.measurements.push_back({.name = "table_coverage",
                                 .value = 100.0 * held / bins,
                                 .unit = "pct",
                                 .low = min_pct,
                                 .first_us = context.evidence.first_us,
                                 .last_us = context.evidence.last_us});
  JudgeCheck(result);
  return result;
}

CheckResult CheckTableAccuracy(const Expectation& expect, const CheckContext& context) {
  const double from = expect.number("from_degc", -100), to = expect.number("to_degc", 200);
  const double within = expect.number("within_mdps", 0);
  CheckResult result = Start(
      expect, fmt::format("learned entries from {:g} to {:g} degC within {:g} mdps of the rig's "
                          "long average",
                          from, to, within));
  const auto table = FinalTable(context.evidence);
  for (int i = 0; table && i < table->size(); ++i) {
    const zro::Entry& entry = (*table)[i];
    if (entry.origin != zro::Origin::kLearned || entry.temp_degc < from || entry.temp_degc > to) {
      continue;
    }
    const auto reference = ReferenceAt(context.evidence, entry.temp_degc);
    if (!reference) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.measurements.push_back(
          {.name = fmt::format("table_accuracy.{:.1f}.{}", entry.temp_degc, kAxisName[axis]),
           .value = MdpsFromDps(entry.zro_dps[axis] - reference->zro_dps[axis]),
           .unit = "mdps",
           .low = -within,
           .high = within,
           .uncertainty_k2 = MdpsFromDps(reference->uncertainty_k2_dps[axis]),
           .first_us = reference->first_us,
           .last_us = reference->last_us});
    }
  }
  if (result.measurements.empty()) {
    result.reason = "no learned entry has a still and silent average at its temperature";
  }
  JudgeCheck(result);
  return result;
}

namespace {

/// Whether two entries are the same, but for merges that were not committed yet.
bool SameButForMerges(const zro::Entry& a, const zro::Entry& b) {
  constexpr float kMerged_degc = 1.25f;  ///< half a bin: an entry stays in its own
  constexpr float kMerged_dps = 0.02f;
  bool same = a.origin == b.origin && std::abs(a.temp_degc - b.temp_degc) < kMerged_degc;
  for (int axis = 0; axis < zro::kAxes; ++axis) {
    same = same && std::abs(a.zro_dps[axis] - b.zro_dps[axis]) <= kMerged_dps;
  }
  return same;
}

/// Entries of `before` that `after` lacks or holds with other offsets.
int EntriesLost(const zro::Table& before, const zro::Table& after) {
  int lost = 0;
  for (int i = 0; i < before.size(); ++i) {
    bool kept = false;
    for (int j = 0; j < after.size(); ++j) kept = kept || SameButForMerges(before[i], after[j]);
    lost += kept ? 0 : 1;
  }
  return lost;
}

Measurement Persistence(const TableItem& before, const TableItem& after, bool clean) {
  Measurement m{.name = "table_persists.entries_lost",
                .unit = "1",
                .high = 0,
                .first_us = before.at_us,
                .last_us = after.at_us};
  zro::Table was, is;
  std::uint32_t generation = 0;
  const bool readable = was.FromImage(before.image.data(), before.image.size(), &generation) &&
                        is.FromImage(after.image.data(), after.image.size(), &generation);
  if (!readable) {
    m.value = std::nan("");
  } else {
    m.value = EntriesLost(was, is);
    // Nothing was pending: then every byte must be the same.
    if (clean && before.image != after.image) m.value = std::max(m.value, 1.0);
  }
  return m;
}

/// Nothing waited to be stored when the supply went between these two looks at the table.
bool WasClean(const Evidence& evidence, const TableItem& before, const TableItem& after) {
  return std::all_of(evidence.cuts.begin(), evidence.cuts.end(), [&](const PowerCut& cut) {
    return cut.clean || cut.at_us < before.at_us || cut.at_us > after.at_us;
  });
}

}  // namespace

CheckResult CheckTablePersists(const Expectation& expect, const CheckContext& context) {
  CheckResult result = Start(expect, "the committed table survives every power cut");
  const TableItem* before = nullptr;
  for (const TableItem& table : context.evidence.tables) {
    if (table.when == 1) before = &table;
    if (table.when != 2 || before == nullptr) continue;
    result.measurements.push_back(
        Persistence(*before, table, WasClean(context.evidence, *before, table)));
    before = nullptr;
  }
  if (result.measurements.empty()) result.reason = "the board was never power-cycled";
  JudgeCheck(result);
  return result;
}

}  // namespace zrobench
