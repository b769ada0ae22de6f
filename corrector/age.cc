#include "corrector/age.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

// Long-term drift of a consumer MEMS offset: some tens of mdps over weeks after soldering and
// stress, then levelling off.
constexpr float kDriftDpsPerDay = 0.001f;
constexpr float kMaxDriftDps = 0.03f;
constexpr float kUnknownDriftDps = 0.01f;

}  // namespace

std::uint16_t Age::Of(const Entry& entry) const {
  if (today_ == 0 || entry.date == 0) return kUnknown;
  if (entry.date > today_) return entry.date == today_ + 1 ? 0 : kUnknown;
  return static_cast<std::uint16_t>(today_ - entry.date);
}

bool Age::IsOld(const Entry& entry) const {
  if (today_ == 0) return false;
  const std::uint16_t days = Of(entry);
  return days == kUnknown || days > old_days_;
}

bool Age::IsRecent(const Entry& entry) const {
  if (IsOld(entry)) return false;
  const std::uint16_t days = Of(entry);
  return days == kUnknown || days <= recent_days_;
}

float Age::SigmaOf(const Entry& entry) const {
  const std::uint16_t days = Of(entry);
  if (days == kUnknown) return kUnknownDriftDps;
  return Min(kMaxDriftDps, kDriftDpsPerDay * static_cast<float>(days));
}

}  // namespace zro
