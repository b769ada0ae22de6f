#pragma once
// Non-volatile memory behind the table: two slots of equal size, written whole, one at a time.
#include <cstddef>
#include <cstdint>

namespace zro {

/// The customer's flash, EEPROM or file. Borrowed by the corrector; calls block until done.
/// A write may be cut by a power failure at any byte; the store (corrector/store.h) survives that.
class Storage {
 public:
  static constexpr int kSlots = 2;
  virtual bool Read(int slot, std::uint8_t* out, std::size_t size) = 0;
  virtual bool Write(int slot, const std::uint8_t* data, std::size_t size) = 0;

 protected:
  ~Storage() = default;  // never deleted through the interface: no heap on the target
};

}  // namespace zro
