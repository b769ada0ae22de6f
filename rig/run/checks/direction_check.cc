// up_down: is there one offset a temperature, whichever way it came?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"
#include "rig/run/reference.h"

namespace zrobench {
namespace {

/// Less is a controller that hunts, not a change of direction.
constexpr double kTurn_degc = 1.0;

/// Seconds while the board warmed (`up`) or cooled: the others are kept, but not quiet. A soak
/// belongs to the direction from which it was reached.
std::vector<Second> OneWay(const std::vector<Second>& seconds, bool up) {
  std::vector<Second> kept = seconds;
  int direction = 0;
  double extreme_degc = kept.empty() ? 0 : kept.front().mean.imu_degc;
  for (Second& second : kept) {
    const double degc = second.mean.imu_degc;
    const double moved_degc = degc - extreme_degc;
    if (direction == 0 || moved_degc * direction < 0) {
      if (std::abs(moved_degc) >= kTurn_degc) direction = moved_degc > 0 ? 1 : -1;
    }
    if (moved_degc * direction > 0) extreme_degc = degc;
    second.quiet = second.quiet && direction == (up ? 1 : -1);
  }
  return kept;
}

}  // namespace

CheckResult CheckUpDown(const Expectation& expect, const CheckContext& context) {
  const double within = expect.number("within_mdps", 0);
  CheckResult result = StartCheck(
      expect, fmt::format("the raw gyro's offset at a learned temperature, warming against "
                          "cooling, within {:g} mdps",
                          within));
  const auto table = FinalTable(context.evidence);
  const auto warming = OneWay(context.evidence.seconds, true);
  const auto cooling = OneWay(context.evidence.seconds, false);
  for (int i = 0; table && i < table->size(); ++i) {
    const zro::Entry& entry = (*table)[i];
    if (entry.origin != zro::Origin::kLearned) continue;
    const auto up = ReferenceAt(warming, entry.temp_degc);
    const auto down = ReferenceAt(cooling, entry.temp_degc);
    if (!up || !down) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.measurements.push_back(
          {.name = fmt::format("up_down.{:.1f}.{}", entry.temp_degc, "xyz"[axis]),
           .value = MdpsFromDps(up->zro_dps[axis] - down->zro_dps[axis]),
           .unit = "mdps",
           .low = -within,
           .high = within,
           .uncertainty_k2 = MdpsFromDps(
               std::hypot(up->uncertainty_k2_dps[axis], down->uncertainty_k2_dps[axis])),
           .first_us = std::min(up->first_us, down->first_us),
           .last_us = std::max(up->last_us, down->last_us)});
    }
  }
  if (result.measurements.empty()) {
    result.reason = "no learned temperature was reached both warming and cooling";
  }
  JudgeCheck(result);
  return result;
}

}  // namespace zrobench
