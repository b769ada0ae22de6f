#pragma once
// Appends little-endian numbers to a byte buffer; corrector/bytes.h reads them back.
#include <cstddef>
#include <cstdint>

#include "corrector/bytes.h"

namespace zro::node {

/// Appends to a borrowed buffer; what does not fit is dropped and ok() turns false.
class ByteWriter {
 public:
  ByteWriter(std::uint8_t* out, std::size_t capacity) : out_(out), capacity_(capacity) {}
  void Put(std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) PutByte(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void PutFloat(float value) {
    std::uint8_t bytes[4];
    zro::PutFloat(value, bytes);
    PutBytes(bytes, 4);
  }
  void PutBytes(const void* from, std::size_t size) {
    const auto* bytes = static_cast<const std::uint8_t*>(from);
    for (std::size_t i = 0; i < size; ++i) PutByte(bytes[i]);
  }
  std::size_t size() const { return size_; }
  bool ok() const { return ok_; }

 private:
  void PutByte(std::uint8_t byte) {
    ok_ = ok_ && size_ < capacity_;
    if (ok_) out_[size_++] = byte;
  }
  std::uint8_t* out_;
  std::size_t capacity_;
  std::size_t size_ = 0;
  bool ok_ = true;
};

}  // namespace zro::node
