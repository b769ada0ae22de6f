#include "rig/run/checks/checks.h"

#include <array>
#include <utility>

#include "core/check.h"

namespace zrobench {

CheckResult StartCheck(const Expectation& expect, std::string about) {
  CheckResult result;
  result.check = expect.check;
  result.about = std::move(about);
  return result;
}

CheckResult RunCheck(const Expectation& expect, const CheckContext& context) {
  using Check = CheckResult (*)(const Expectation&, const CheckContext&);
  static constexpr std::array<std::pair<std::string_view, Check>, 14> kChecks = {{
      {"table_coverage", CheckTableCoverage},
      {"table_accuracy", CheckTableAccuracy},
      {"rejects", CheckRejects},
      {"no_corrupt_entry", CheckNoCorruptEntry},
      {"table_persists", CheckTablePersists},
      {"lockstep", CheckLockstep},
      {"residual_rate", CheckResidualRate},
      {"no_unexpected_rejection", CheckNoUnexpectedRejection},
      {"decides", CheckDecides},
      {"table_complete", CheckTableComplete},
      {"granularity", CheckGranularity},
      {"entry_age", CheckEntryAge},
      {"up_down", CheckUpDown},
      {"extrapolation_held", CheckExtrapolationHeld},
  }};
  for (const auto& [name, check] : kChecks) {
    if (expect.check == name) return check(expect, context);
  }
  constexpr bool kLoaderKnowsEveryCheck = false;
  ZROBENCH_CHECK(kLoaderKnowsEveryCheck);
  return {};
}

}  // namespace zrobench
