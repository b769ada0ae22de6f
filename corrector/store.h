#pragma once
// The table in non-volatile memory: two slots, written in turn, so that a power cut at any byte of
// a write leaves the old table or the new one.
#include <cstddef>
#include <cstdint>

#include "corrector/storage.h"
#include "corrector/table.h"

namespace zro {

/// A slot: u32 magic, u16 slot version, u16 image length, u32 sequence, the table's canonical image
/// padded with zeros, u32 CRC-32/ISO-HDLC over all before it. Little endian. The newest valid slot
/// holds; a write goes to the other one.
class Store {
 public:
  static constexpr std::uint32_t kMagic = 0x544F525Au;  // "ZROT"
  static constexpr std::uint16_t kVersion = 1;
  static constexpr std::size_t kPrefixBytes = 12;
  static constexpr std::size_t kSlotBytes = kPrefixBytes + Table::kMaxImageBytes + 4;

  enum class Load : std::uint8_t { kBlank, kLoaded, kInvalid };

  /// `storage` is borrowed; null: nothing is ever kept.
  explicit Store(Storage* storage) : storage_(storage) {}

  /// Blank: every slot all 0xFF or all 0x00. Invalid (table unchanged): something is there, but
  /// nothing valid, or it cannot be read.
  Load Read(Table* table, std::uint32_t* generation);

  /// Writes the slot that is not the newest and reads it back: worn memory may say yes and keep
  /// something else. False when the storage failed; the newest stays.
  bool Write(const Table& table, std::uint32_t generation);

  /// A slot's bytes, as Write makes them; `out` has room for kSlotBytes. For hosts that start a
  /// corrector from a table image.
  static void Seal(const Table& table, std::uint32_t generation, std::uint32_t sequence,
                   std::uint8_t* out);

 private:
  Storage* storage_;
  std::uint32_t sequence_ = 0;
  std::int8_t newest_ = -1;
};

}  // namespace zro
