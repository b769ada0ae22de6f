#pragma once
// How old entries are, when dates may be missing or the clock was set back.
#include <cstdint>

#include "corrector/config.h"
#include "corrector/table.h"

namespace zro {

/// Ages against today's date (days since 1984-01-01, 0 = unknown).
class Age {
 public:
  static constexpr std::uint16_t kUnknown = 0xFFFF;

  Age(std::uint16_t today, const Config& config)
      : today_(today), recent_days_(config.recent_days), old_days_(config.old_days) {}

  /// Age in days; kUnknown without a date on either side, or when the entry is dated more than a
  /// day ahead (a clock was wrong). One day ahead is a change of time zone: age 0.
  std::uint16_t Of(const Entry& entry) const;

  /// Fig. 5, 54. Without today's date nothing can be shown to be old. With it, an entry of unknown
  /// age counts as old: a confirming reading then overwrites and thereby dates it.
  bool IsOld(const Entry& entry) const;

  /// Fig. 5, 57. Not old, and not known to be older than recent_days.
  bool IsRecent(const Entry& entry) const;

  /// 1 sigma that ageing may have added to the entry's own uncertainty.
  float SigmaOf(const Entry& entry) const;

 private:
  std::uint16_t today_;
  std::uint16_t recent_days_;
  std::uint16_t old_days_;
};

}  // namespace zro
