#include "rig/record/utc_text.h"

#include <fmt/format.h>

#include <cstdio>
#include <limits>

namespace zrobench {
namespace {

using std::chrono::days;
using std::chrono::sys_days;

constexpr std::int64_t kNsPerDay = 86'400'000'000'000;
constexpr sys_days kCanopenStart{std::chrono::year(1984) / 1 / 1};

std::optional<sys_days> Day(int year, unsigned month, unsigned day) {
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month),
                                         std::chrono::day(day)};
  // Outside these years a UtcNs overflows.
  if (!date.ok() || year < 1700 || year > 2200) return std::nullopt;
  return sys_days(date);
}

}  // namespace

std::string UtcText(UtcNs utc) {
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(utc)};
  const auto day = std::chrono::floor<days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(std::chrono::floor<std::chrono::microseconds>(time - day));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z", int(date.year()),
                     unsigned(date.month()), unsigned(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), clock.subseconds().count());
}

std::optional<UtcNs> ParseUtc(std::string_view view) {
  const std::string text(view);
  int year = 0, hour = 0, minute = 0, at = 0;
  unsigned month = 0, day_of_month = 0;
  double second = 0;
  if (std::sscanf(text.c_str(), "%4d-%2u-%2u%n", &year, &month, &day_of_month, &at) != 3) {
    return std::nullopt;
  }
  const auto day = Day(year, month, day_of_month);
  if (!day) return std::nullopt;
  std::string rest = text.substr(static_cast<std::size_t>(at));
  if (!rest.empty()) {
    at = 0;
    if (std::sscanf(rest.c_str(), "T%2d:%2d:%lf%n", &hour, &minute, &second, &at) != 3) {
      return std::nullopt;
    }
    rest = rest.substr(static_cast<std::size_t>(at));
    if (rest != "Z" && !rest.empty()) return std::nullopt;
    const bool in_range = hour >= 0 && hour < 24 && minute >= 0 && minute < 60;
    if (!in_range || !(second >= 0 && second < 60)) return std::nullopt;
  }
  return day->time_since_epoch().count() * kNsPerDay + (hour * 60 + minute) * 60'000'000'000LL +
         FromSeconds(second).count();
}

std::uint16_t CanopenDays(UtcNs utc) {
  const auto since = utc / kNsPerDay - kCanopenStart.time_since_epoch().count();
  if (since < 0) return 0;
  return static_cast<std::uint16_t>(
      std::min<std::int64_t>(since, std::numeric_limits<std::uint16_t>::max()));
}

std::string CanopenDateText(std::uint16_t count) {
  const sys_days day = kCanopenStart + days(count);
  return UtcText(day.time_since_epoch().count() * kNsPerDay).substr(0, 10);
}

}  // namespace zrobench
