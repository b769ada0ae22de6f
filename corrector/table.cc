#include "corrector/table.h"

#include <string.h>

#include "corrector/arithmetic.h"

namespace zro {
namespace {

constexpr float kSaneDegc = 200.0f;
constexpr float kSaneDps = 4000.0f;  // the widest full scale of any MEMS gyro

}  // namespace

bool IsBefore(const Entry& a, const Entry& b) {
  return a.temp_degc < b.temp_degc || (a.temp_degc == b.temp_degc && a.origin < b.origin);
}

bool IsFit(const Entry& e) {
  for (const float zro : e.zro_dps) {
    if (!IsSane(zro, kSaneDps)) return false;
  }
  return IsSane(e.temp_degc, kSaneDegc) && IsSane(e.sigma_dps, kSaneDps) && e.sigma_dps >= 0.0f &&
         e.weight >= 1 && (e.origin == Origin::kFactory || e.origin == Origin::kLearned);
}

int Table::BinOf(float temp_degc) const { return Floor((temp_degc - kFirstBinDegc) / bin_degc_); }

int Table::Nearest(float temp_degc) const {
  int nearest = -1;
  float least = 0.0f;
  for (int i = 0; i < size_; ++i) {
    const float distance = fabsf(entries_[i].temp_degc - temp_degc);
    if ((nearest >= 0 && distance >= least) || !IsActive(i)) continue;
    nearest = i;
    least = distance;
  }
  return nearest;
}

int Table::InBin(float temp_degc, Origin origin) const {
  const int bin = BinOf(temp_degc);
  for (int i = 0; i < size_; ++i) {
    if (entries_[i].origin == origin && BinOf(entries_[i].temp_degc) == bin) return i;
  }
  return -1;
}

bool Table::IsActive(int index, int without) const {
  if (index == without) return false;
  if (entries_[index].origin == Origin::kLearned) return true;
  for (int i = 0; i < size_; ++i) {
    if (i == without || entries_[i].origin != Origin::kLearned) continue;
    if (fabsf(entries_[i].temp_degc - entries_[index].temp_degc) <= bin_degc_) return false;
  }
  return true;
}

int Table::Displaceable() const {
  int oldest = -1;
  for (int i = 0; i < size_; ++i) {
    if (entries_[i].origin != Origin::kLearned) continue;
    if (oldest < 0 || entries_[i].date < entries_[oldest].date) oldest = i;
  }
  return oldest;
}

bool Table::Insert(const Entry& entry) {
  if (!IsFit(entry)) return false;
  const int same = InBin(entry.temp_degc, entry.origin);
  if (same >= 0) {
    Remove(same);
  } else if (entry.origin == Origin::kFactory) {
    int factory = 0;
    for (int i = 0; i < size_; ++i) factory += entries_[i].origin == Origin::kFactory ? 1 : 0;
    if (factory == kFactoryCapacity) return false;
  }
  if (size_ == kCapacity) {
    const int oldest = Displaceable();
    if (oldest < 0) return false;
    Remove(oldest);
  }
  int at = size_;
  while (at > 0 && IsBefore(entry, entries_[at - 1])) {
    entries_[at] = entries_[at - 1];
    --at;
  }
  entries_[at] = entry;
  ++size_;
  return true;
}

void Table::Replace(int index, const Entry& entry) {
  Remove(index);
  Insert(entry);
}

void Table::Remove(int index) {
  const auto behind = static_cast<std::size_t>(size_ - index - 1);
  memmove(&entries_[index], &entries_[index + 1], behind * sizeof(Entry));
  --size_;
}

}  // namespace zro
