// table_persists: what a power cut may cost, and what it may not.
#include <algorithm>
#include <cmath>
#include <vector>

#include "corrector/table.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"

namespace zrobench {
namespace {

constexpr std::uint64_t kSecond_us = 1'000'000;
/// What was written this long before the cut need not be stored yet (corrector/README.md, Store).
constexpr std::uint64_t kCommit_us = kSecond_us;
/// The board says once a second whether something waits to be stored.
constexpr std::uint64_t kStatus_us = kSecond_us + kSecond_us / 2;
constexpr double kBin_degc = 2.5;

struct Image {
  zro::Table table;
  std::uint32_t generation = 0;
  bool readable = false;
  explicit Image(const TableItem& item)
      : readable(table.FromImage(item.image.data(), item.image.size(), &generation)) {}
};

/// Temperatures at which the board wrote an entry from `from_us` to `to_us`.
std::vector<double> WrittenBetween(const Evidence& evidence, std::uint64_t from_us,
                                   std::uint64_t to_us) {
  std::vector<double> written_degc;
  for (const TimedDecision& decision : evidence.decisions) {
    if (!zro::IsWrite(decision.record.code)) continue;
    if (decision.at_us < from_us || decision.at_us > to_us) continue;
    written_degc.push_back(decision.record.temp_degc);
  }
  return written_degc;
}

/// Whether `after` still holds the entry, but for merges that were not committed yet: these may
/// have moved it anywhere in its bin, and its offsets along with the temperature.
bool HoldsButForMerges(const zro::Table& after, const zro::Entry& entry) {
  constexpr float kMerged_dps = 0.02f;
  const int at = after.InBin(entry.temp_degc, entry.origin);
  if (at < 0) return false;
  const bool moved = after[at].temp_degc != entry.temp_degc;
  const zro::Estimate curve = after.At(entry.temp_degc);
  bool same = true;
  for (int axis = 0; axis < zro::kAxes; ++axis) {
    const float now_dps = moved ? curve.zro_dps[axis] : after[at].zro_dps[axis];
    same = same && std::abs(entry.zro_dps[axis] - now_dps) <= kMerged_dps;
  }
  return same;
}

/// Entries of `before` that `after` lacks or holds with other offsets; those written a moment
/// before the cut (`fresh_degc`) are allowed to be lost.
int EntriesLost(const zro::Table& before, const zro::Table& after,
                const std::vector<double>& fresh_degc) {
  int lost = 0;
  for (int i = 0; i < before.size(); ++i) {
    bool kept = std::any_of(fresh_degc.begin(), fresh_degc.end(), [&](double degc) {
      return std::abs(before[i].temp_degc - degc) < kBin_degc;
    });
    kept = kept || HoldsButForMerges(after, before[i]);
    lost += kept ? 0 : 1;
  }
  return lost;
}

/// The cut between two looks at the table; none: as if at the second look.
PowerCut CutBetween(const Evidence& evidence, const TableItem& before, const TableItem& after) {
  PowerCut found{after.at_us, true};
  for (const PowerCut& cut : evidence.cuts) {
    if (cut.at_us >= before.at_us && cut.at_us <= after.at_us) found = cut;
  }
  return found;
}

Measurement Persistence(const Evidence& evidence, const TableItem& before, const TableItem& after) {
  Measurement m{.name = "table_persists.entries_lost",
                .unit = "1",
                .high = 0,
                .first_us = before.at_us,
                .last_us = after.at_us};
  const Image was(before), is(after);
  if (!was.readable || !is.readable) {
    m.value = std::nan("");
    return m;
  }
  const PowerCut cut = CutBetween(evidence, before, after);
  const auto since = [&](std::uint64_t span_us) {
    return WrittenBetween(evidence, cut.at_us - std::min(cut.at_us, span_us), cut.at_us);
  };
  m.value = EntriesLost(was.table, is.table, since(kCommit_us));
  // Nothing waited to be stored, and nothing was stored after the first look: every byte is there.
  const bool settled = cut.clean && since(kStatus_us).empty() && is.generation <= was.generation;
  if (settled && before.image != after.image) m.value = std::max(m.value, 1.0);
  return m;
}

}  // namespace

CheckResult CheckTablePersists(const Expectation& expect, const CheckContext& context) {
  CheckResult result = StartCheck(expect, "the committed table survives every power cut");
  const TableItem* before = nullptr;
  for (const TableItem& table : context.evidence.tables) {
    if (table.when == 1) before = &table;
    if (table.when != 2 || before == nullptr) continue;
    result.measurements.push_back(Persistence(context.evidence, *before, table));
    before = nullptr;
  }
  if (result.measurements.empty()) result.reason = "the board was never power-cycled";
  JudgeCheck(result);
  return result;
}

}  // namespace zrobench
