#pragma once
// One function a check: what a profile may expect of a corrector. Each measures from the evidence
// alone and is judged with its uncertainty. Names and arguments: rig/profile/expectations.cc.
#include <optional>
#include <string>

#include "corrector/table.h"
#include "rig/profile/profile.h"
#include "rig/record/verdict.h"
#include "rig/run/evidence.h"

namespace zrobench {

struct CheckContext {
  const Evidence& evidence;
  const Station& station;
  std::filesystem::path record;  ///< record.ulg, for checks that go through every sample again
};

/// Share of the bins from_degc..to_degc (every step_degc) that hold an entry at the end.
CheckResult CheckTableCoverage(const Expectation& expect, const CheckContext& context);
/// Entries learned in from_degc..to_degc against the rig's own long average of the raw gyro.
CheckResult CheckTableAccuracy(const Expectation& expect, const CheckContext& context);
/// At least `at_least` refusals with one of `codes` while a stimulus of kind `during` acted.
CheckResult CheckRejects(const Expectation& expect, const CheckContext& context);
/// No entry was written from a reading that overlaps a stimulus, and none is far from the truth.
CheckResult CheckNoCorruptEntry(const Expectation& expect, const CheckContext& context);
/// After each power cut the table is the one last committed.
CheckResult CheckTablePersists(const Expectation& expect, const CheckContext& context);
/// The corrector, run again on the host over the recorded integers, made the same table and events.
CheckResult CheckLockstep(const Expectation& expect, const CheckContext& context);
/// Mean corrected rate over pieces of piece_s (10) while still and silent stays at zero, where the
/// board is within from_degc..to_degc (anywhere).
CheckResult CheckResidualRate(const Expectation& expect, const CheckContext& context);

/// At most `at_most` refusals (codes 1..16) where no stimulus acted nor had just acted.
CheckResult CheckNoUnexpectedRejection(const Expectation& expect, const CheckContext& context);
/// Between `at_least` and `at_most` decisions with one of `codes` (1..41), anywhere in the run.
CheckResult CheckDecides(const Expectation& expect, const CheckContext& context);
/// The board called its table complete (code 40) and has not taken it back (41).
CheckResult CheckTableComplete(const Expectation& expect, const CheckContext& context);
/// Largest gap between neighbouring learned entries within from_degc..to_degc, its ends included.
CheckResult CheckGranularity(const Expectation& expect, const CheckContext& context);
/// Learned entries (of from_degc..to_degc, where given) are dated, and by the rig's last date no
/// older than `at_most_days`.
CheckResult CheckEntryAge(const Expectation& expect, const CheckContext& context);
/// The rig's averages while warming and while cooling differ by no more than within_mdps: one value
/// a temperature can be right for both.
CheckResult CheckUpDown(const Expectation& expect, const CheckContext& context);
/// More than beyond_degc outside the table's outermost entries the correction stays as it is there.
CheckResult CheckExtrapolationHeld(const Expectation& expect, const CheckContext& context);

/// A result that has yet to measure: `about` says in a line what is looked at.
CheckResult StartCheck(const Expectation& expect, std::string about);

/// The table as the record last showed it; nothing when the record holds none that can be read.
std::optional<zro::Table> FinalTable(const Evidence& evidence);

/// Runs the check an expectation names. An unknown name is a contract bug: the loader refuses it.
CheckResult RunCheck(const Expectation& expect, const CheckContext& context);

}  // namespace zrobench
