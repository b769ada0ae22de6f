#pragma once
// May a reading enter the table? (US 8,577,633 B2, fig. 5, in its order)
#include "corrector/age.h"
#include "corrector/quality.h"
#include "corrector/reading.h"
#include "corrector/table.h"

namespace zro {

/// Outcome of figure 5. `finding.code` is one of kNew, kMerged, kOverwroteOld, kRecentNothingToDo
/// (the reading is sane) or kDiffersFromEntry, kDiffersFromEstimate (it is not). Value and limit:
/// difference from what was expected and its tolerance, dps; for kNew on an empty table |offset|
/// and the bias limit, the only check possible.
struct Decision {
  Finding finding;
  int entry;                  ///< entry to merge with or overwrite; -1: none in this bin
  float expected_dps[kAxes];  ///< by the table at the reading's temperature; 0 when empty
  float expected_sigma_dps;   ///< 1 sigma of it
};

/// Pure function of its arguments; changes nothing. `may_merge`: a recent entry may be corroborated
/// by the reading; otherwise it is taken in only while that makes a coarse entry finer.
Decision CheckSanity(const Table& table, const Summary& reading, const Age& age,
                     const Limits& limits, bool may_merge);

/// The entry a reading makes of `entry` when merged by variance. Unlike a plain average it never
/// settles for good: the newest reading always has at least an eighth. `corroborates`: it is
/// another witness, not more of the same still.
Entry Merge(const Entry& entry, const Summary& reading, const Age& age, bool corroborates);

}  // namespace zro
