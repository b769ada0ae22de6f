#pragma once
// The virtual board's non-volatile memory: outlives reboots, is written whole or (power cut)
// partly.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "corrector/storage.h"

namespace zrobench {

/// RAM that plays two flash slots. Blank (0xFF) at first.
class VirtualFlash final : public zro::Storage {
 public:
  bool Read(int slot, std::uint8_t* out, std::size_t size) override {
    const auto& bytes = Slot(slot, size);
    std::copy_n(bytes.begin(), size, out);
    return true;
  }
  bool Write(int slot, const std::uint8_t* data, std::size_t size) override {
    std::copy_n(data, size, Slot(slot, size).begin());
    ++writes_;
    return true;
  }
  std::uint64_t writes() const { return writes_; }

 private:
  std::vector<std::uint8_t>& Slot(int slot, std::size_t size) {
    auto& bytes = slots_.at(static_cast<std::size_t>(slot));
    if (bytes.size() < size) bytes.resize(size, 0xFF);
    return bytes;
  }
  std::array<std::vector<std::uint8_t>, kSlots> slots_;
  std::uint64_t writes_ = 0;
};

}  // namespace zrobench
