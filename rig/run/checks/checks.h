#pragma once
// One function a check: what a profile may expect of a corrector. Each measures from the evidence
// alone and is judged with its uncertainty. Names and arguments: rig/profile/check_catalogue.
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
/// Mean corrected rate over 10 s pieces while still and silent stays at zero.
CheckResult CheckResidualRate(const Expectation& expect, const CheckContext& context);

/// Runs the check an expectation names. An unknown name is a contract bug: the loader refuses it.
CheckResult RunCheck(const Expectation& expect, const CheckContext& context);

}  // namespace zrobench
