#include "rig/profile/limits.h"

#include <fmt/format.h>

namespace zrobench {

std::string LimitOf(const Station& station, std::string_view key) {
  return fmt::format("{} of station {}", key, station.path.string());
}

Range Limited(double low, double high, const std::string& low_reason,
              const std::string& high_reason) {
  Range range = Range::Between(low, high);
  range.low_reason = low_reason;
  range.high_reason = high_reason;
  return range;
}

Range DurationRange() {
  constexpr double kTick_s = 0.1;
  constexpr double kWeek_s = 7 * 86400.0;  // longer is a slip of units
  return Limited(kTick_s, kWeek_s, "the bench's tick", "seven days");
}

Range SetPointRange(const Station& station) {
  return Limited(station.limits.min_degc, station.limits.max_degc, LimitOf(station, "min_degc"),
                 LimitOf(station, "max_degc"));
}

}  // namespace zrobench
