// The canonical image: the same bytes on every machine, whatever its byte order or padding.
#include <string.h>

#include "corrector/bytes.h"
#include "corrector/table.h"

namespace zro {
namespace {

void PutEntry(const Entry& e, std::uint8_t* out) {
  PutFloat(e.temp_degc, out);
  for (int axis = 0; axis < kAxes; ++axis) PutFloat(e.zro_dps[axis], out + 4 + 4 * axis);
  PutFloat(e.sigma_dps, out + 16);
  PutU16(e.date, out + 20);
  out[22] = e.weight;
  out[23] = static_cast<std::uint8_t>(e.origin);
}

Entry GetEntry(const std::uint8_t* in) {
  Entry e{};
  e.temp_degc = GetFloat(in);
  for (int axis = 0; axis < kAxes; ++axis) e.zro_dps[axis] = GetFloat(in + 4 + 4 * axis);
  e.sigma_dps = GetFloat(in + 16);
  e.date = GetU16(in + 20);
  e.weight = in[22];
  e.origin = static_cast<Origin>(in[23]);
  return e;
}

/// Origin of a table whose entries have these: 0 none, else the highest.
std::uint8_t Combined(std::uint8_t so_far, Origin origin) {
  const auto value = static_cast<std::uint8_t>(origin);
  return value > so_far ? value : so_far;
}

/// Walks the entries without storing them, so that a bad image changes nothing. `table` tells bins.
bool EntriesAreCanonical(const std::uint8_t* first, int count, std::uint8_t origin,
                         const Table& table) {
  std::uint8_t combined = 0;
  Entry previous{};
  Entry latest[2] = {};  // of either origin; weight 0: none yet
  int factory = 0;
  for (int i = 0; i < count; ++i) {
    const Entry entry = GetEntry(first + static_cast<std::size_t>(i) * Table::kEntryBytes);
    if (!IsFit(entry) || (i > 0 && !IsBefore(previous, entry))) return false;
    Entry& before = latest[entry.origin == Origin::kFactory ? 0 : 1];
    const int bin = table.BinOf(entry.temp_degc);
    if (before.weight > 0 && table.BinOf(before.temp_degc) == bin) return false;
    factory += entry.origin == Origin::kFactory ? 1 : 0;
    combined = Combined(combined, entry.origin);
    previous = before = entry;
  }
  return combined == origin && factory <= Table::kFactoryCapacity;
}

}  // namespace

std::size_t Table::ToImage(std::uint32_t generation, std::uint8_t* out) const {
  memset(out, 0, kHeaderBytes);
  PutU16(kLayoutVersion, out);
  PutU16(static_cast<std::uint16_t>(size_), out + 2);
  PutU32(generation, out + 4);
  std::uint8_t* at = out + kHeaderBytes;
  for (int i = 0; i < size_; ++i, at += kEntryBytes) {
    out[8] = Combined(out[8], entries_[i].origin);
    PutEntry(entries_[i], at);
  }
  return static_cast<std::size_t>(at - out);
}

bool Table::FromImage(const std::uint8_t* image, std::size_t size, std::uint32_t* generation) {
  if (size < kHeaderBytes || GetU16(image) != kLayoutVersion) return false;
  const int count = GetU16(image + 2);
  if (count > kCapacity) return false;
  if (size != kHeaderBytes + static_cast<std::size_t>(count) * kEntryBytes) return false;
  for (std::size_t i = 9; i < kHeaderBytes; ++i) {
    if (image[i] != 0) return false;
  }
  const std::uint8_t* first = image + kHeaderBytes;
  if (!EntriesAreCanonical(first, count, image[8], *this)) return false;
  for (int i = 0; i < count; ++i) {
    entries_[i] = GetEntry(first + static_cast<std::size_t>(i) * kEntryBytes);
  }
  size_ = count;
  *generation = GetU32(image + 4);
  return true;
}

}  // namespace zro
