#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "core/clock.h"

namespace zrobench {

/// "2026-01-01T00:00:00.000000Z" (ISO 8601, microseconds).
std::string UtcText(UtcNs utc);
/// Reads "2026-01-01", "2026-01-01T12:30:00Z" or with fractions; nothing when it is no such text.
std::optional<UtcNs> ParseUtc(std::string_view text);
/// Days since 1984-01-01 (CiA 301 TIME_OF_DAY), 0 before then.
std::uint16_t CanopenDays(UtcNs utc);
/// "2026-01-01" of such days.
std::string CanopenDateText(std::uint16_t days);

}  // namespace zrobench
