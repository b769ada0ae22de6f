#pragma once
// The canonical image of a corrector's table at one moment (objects 0x2000, 0x2001; DUT_IDENT).
#include <cstddef>
#include <cstdint>

#include "corrector/bytes.h"
#include "corrector/corrector.h"
#include "corrector/crc32.h"

namespace zro::node {

class TableImage {
 public:
  void Take(const Corrector& corrector) {
    size_ = corrector.table().ToImage(corrector.generation(), bytes_);
  }
  const std::uint8_t* bytes() const { return bytes_; }
  std::size_t size() const { return size_; }
  std::uint16_t layout() const { return GetU16(bytes_); }
  std::uint16_t entries() const { return GetU16(bytes_ + 2); }
  std::uint32_t generation() const { return GetU32(bytes_ + 4); }
  std::uint8_t origin() const { return bytes_[8]; }
  std::uint32_t crc32() const { return Crc32(bytes_, size_); }

 private:
  std::uint8_t bytes_[Table::kMaxImageBytes] = {};
  std::size_t size_ = 0;
};

}  // namespace zro::node
