#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "corrector/storage.h"
#include "corrector/store.h"

namespace zrobench {

/// The store of a board that the host re-runs. Blank (0xFF) at first; writes always succeed.
class RamStorage final : public zro::Storage {
 public:
  /// Makes a corrector that boots from here have exactly the table of this canonical image, its
  /// generation included. False (and unchanged) when it is no canonical image.
  bool Load(std::span<const std::uint8_t> image) {
    zro::Table table;
    std::uint32_t generation = 0;
    if (!table.FromImage(image.data(), image.size(), &generation)) return false;
    slots_ = Blank();
    // A board that never stored anything has a blank store, not an empty table in it.
    if (generation != 0) zro::Store::Seal(table, generation, 1, slots_[0].data());
    return true;
  }

  bool Read(int slot, std::uint8_t* out, std::size_t size) override {
    if (size > zro::Store::kSlotBytes) return false;
    std::copy_n(slots_.at(static_cast<std::size_t>(slot)).begin(), size, out);
    return true;
  }
  bool Write(int slot, const std::uint8_t* data, std::size_t size) override {
    if (size > zro::Store::kSlotBytes) return false;
    std::copy_n(data, size, slots_.at(static_cast<std::size_t>(slot)).begin());
    return true;
  }

 private:
  using Slots = std::array<std::array<std::uint8_t, zro::Store::kSlotBytes>, kSlots>;
  static Slots Blank() {
    Slots slots;
    for (auto& slot : slots) slot.fill(0xFF);
    return slots;
  }
  Slots slots_ = Blank();
};

}  // namespace zrobench
