// table_coverage, table_accuracy, granularity, entry_age: what the table holds.
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

bool HoldsLearned(const zro::Table& table, double degc, double within_degc) {
  for (int i = 0; i < table.size(); ++i) {
    if (table[i].origin == zro::Origin::kLearned &&
        std::abs(table[i].temp_degc - degc) <= within_degc) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<zro::Table> FinalTable(const Evidence& evidence) {
  if (evidence.tables.empty()) return std::nullopt;
  zro::Table table;
  std::uint32_t generation = 0;
  const auto& image = evidence.tables.back().image;
  if (!table.FromImage(image.data(), image.size(), &generation)) return std::nullopt;
  return table;
}

CheckResult CheckTableCoverage(const Expectation& expect, const CheckContext& context) {
  const double from = expect.number("from_degc", 0), to = expect.number("to_degc", 0);
  const double step = expect.number("step_degc", 2.5), min_pct = expect.number("min_pct", 100);
  CheckResult result = StartCheck(
      expect, fmt::format("entries every {:g} degC from {:g} to {:g} degC", step, from, to));
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
  CheckResult result = StartCheck(
      expect, fmt::format("learned entries from {:g} to {:g} degC within {:g} mdps of the rig's "
                          "long average",
                          from, to, within));
  const auto table = FinalTable(context.evidence);
  const auto now = SameAge(context.evidence, context.evidence.last_us);
  for (int i = 0; table && i < table->size(); ++i) {
    const zro::Entry& entry = (*table)[i];
    if (entry.origin != zro::Origin::kLearned || entry.temp_degc < from || entry.temp_degc > to) {
      continue;
    }
    const auto reference = ReferenceAt(now, entry.temp_degc);
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

CheckResult CheckGranularity(const Expectation& expect, const CheckContext& context) {
  const double from = expect.number("from_degc", 0), to = expect.number("to_degc", 0);
  const double within = expect.number("within_degc", 0);
  CheckResult result = StartCheck(
      expect, fmt::format("neighbouring learned entries from {:g} to {:g} degC within {:g} "
                          "degC of each other",
                          from, to, within));
  const auto table = FinalTable(context.evidence);
  if (!table) {
    result.reason = "the record holds no readable table";
    return result;
  }
  double last_degc = from, gap_degc = 0;
  for (int i = 0; i < table->size(); ++i) {  // sorted by temperature
    const zro::Entry& entry = (*table)[i];
    if (entry.origin != zro::Origin::kLearned || entry.temp_degc < from) continue;
    const double here_degc = std::min<double>(entry.temp_degc, to);
    gap_degc = std::max(gap_degc, here_degc - last_degc);
    last_degc = here_degc;
  }
  gap_degc = std::max(gap_degc, to - last_degc);
  result.measurements.push_back({.name = "granularity.largest_gap",
                                 .value = gap_degc,
                                 .unit = "degc",
                                 .high = within,
                                 .first_us = context.evidence.first_us,
                                 .last_us = context.evidence.last_us});
  JudgeCheck(result);
  return result;
}

CheckResult CheckEntryAge(const Expectation& expect, const CheckContext& context) {
  const double at_most = expect.number("at_most_days", 0);
  const double from = expect.number("from_degc", -HUGE_VAL);
  const double to = expect.number("to_degc", HUGE_VAL);
  const Evidence& evidence = context.evidence;
  CheckResult result = StartCheck(
      expect, fmt::format("learned entries are dated, and at most {:g} days old", at_most));
  const auto table = FinalTable(evidence);
  if (!table || evidence.today_days == 0) {
    result.reason =
        table ? "the rig never told the board the date" : "the record holds no readable table";
    return result;
  }
  int learned = 0, undated = 0;
  const auto measure = [&](std::string name, std::string unit, double value, double high) {
    result.measurements.push_back({.name = std::move(name),
                                   .value = value,
                                   .unit = std::move(unit),
                                   .low = 0,
                                   .high = high,
                                   .first_us = evidence.first_us,
                                   .last_us = evidence.last_us});
  };
  for (int i = 0; i < table->size(); ++i) {
    const zro::Entry& entry = (*table)[i];
    if (entry.origin != zro::Origin::kLearned || entry.temp_degc < from || entry.temp_degc > to) {
      continue;
    }
    ++learned;
    undated += entry.date == 0 ? 1 : 0;
    if (entry.date == 0) continue;
    measure(fmt::format("entry_age.{:.1f}", entry.temp_degc), "d",
            static_cast<double>(evidence.today_days) - entry.date, at_most);
  }
  if (learned > 0) measure("entry_age.undated", "1", undated, 0);
  if (learned == 0) result.reason = "nothing was learned";
  JudgeCheck(result);
  if (evidence.date_back) {
    result.verdict = Verdict::kRigError;
    result.reason = "wall time went backwards during the run: no entry's date can be trusted";
  }
  return result;
}

}  // namespace zrobench
