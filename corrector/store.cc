#include "corrector/store.h"

#include <string.h>

#include "corrector/bytes.h"
#include "corrector/crc32.h"

namespace zro {
namespace {

constexpr std::size_t kCrcAt = Store::kSlotBytes - 4;

enum class Slot : std::uint8_t { kBlank, kInvalid, kValid };

bool IsBlank(const std::uint8_t* slot) {
  for (std::size_t i = 1; i < Store::kSlotBytes; ++i) {
    if (slot[i] != slot[0]) return false;
  }
  return slot[0] == 0xFF || slot[0] == 0x00;
}

Slot Judge(const std::uint8_t* slot, Table* table, std::uint32_t* generation) {
  if (IsBlank(slot)) return Slot::kBlank;
  if (GetU32(slot) != Store::kMagic || GetU16(slot + 4) != Store::kVersion) return Slot::kInvalid;
  if (Crc32(slot, kCrcAt) != GetU32(slot + kCrcAt)) return Slot::kInvalid;
  const std::size_t length = GetU16(slot + 6);
  if (length > Table::kMaxImageBytes) return Slot::kInvalid;
  return table->FromImage(slot + Store::kPrefixBytes, length, generation) ? Slot::kValid
                                                                          : Slot::kInvalid;
}

/// Sequence numbers may wrap; two live slots are never further apart than one.
bool IsNewer(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b) > 0; }

}  // namespace

Store::Load Store::Read(Table* table, std::uint32_t* generation) {
  newest_ = -1;
  if (storage_ == nullptr) return Load::kBlank;
  bool something = false;
  std::uint8_t slot[kSlotBytes];
  for (int i = 0; i < Storage::kSlots; ++i) {
    if (!storage_->Read(i, slot, kSlotBytes)) {
      something = true;
      continue;
    }
    const std::uint32_t sequence = GetU32(slot + 8);
    if (newest_ >= 0 && !IsNewer(sequence, sequence_)) continue;
    const Slot judged = Judge(slot, table, generation);
    something = something || judged == Slot::kInvalid;
    if (judged != Slot::kValid) continue;
    newest_ = static_cast<std::int8_t>(i);
    sequence_ = sequence;
  }
  if (newest_ >= 0) return Load::kLoaded;
  return something ? Load::kInvalid : Load::kBlank;
}

bool Store::Write(const Table& table, std::uint32_t generation) {
  if (storage_ == nullptr) return true;
  const int target = newest_ == 0 ? 1 : 0;
  std::uint8_t slot[kSlotBytes];
  Seal(table, generation, sequence_ + 1, slot);
  const std::uint32_t crc = GetU32(slot + kCrcAt);
  if (!storage_->Write(target, slot, kSlotBytes)) return false;
  if (!storage_->Read(target, slot, kSlotBytes)) return false;
  if (Crc32(slot, kCrcAt) != crc || GetU32(slot + kCrcAt) != crc) return false;
  newest_ = static_cast<std::int8_t>(target);
  ++sequence_;
  return true;
}

void Store::Seal(const Table& table, std::uint32_t generation, std::uint32_t sequence,
                 std::uint8_t* out) {
  memset(out, 0, kSlotBytes);
  const std::size_t length = table.ToImage(generation, out + kPrefixBytes);
  PutU32(kMagic, out);
  PutU16(kVersion, out + 4);
  PutU16(static_cast<std::uint16_t>(length), out + 6);
  PutU32(sequence, out + 8);
  PutU32(Crc32(out, kCrcAt), out + kCrcAt);
}

}  // namespace zro
