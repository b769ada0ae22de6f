#pragma once
// Little-endian integers and IEEE-754 singles in byte buffers, as CiA 301 transfers them.
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace zro::node {

/// Appends to a borrowed buffer; what does not fit is dropped and ok() turns false.
class ByteWriter {
 public:
  ByteWriter(std::uint8_t* out, std::size_t capacity) : out_(out), capacity_(capacity) {}
  void Put(std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) PutByte(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void PutFloat(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    Put(bits, 4);
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

inline std::uint32_t GetU32(const std::uint8_t* p) {
  return static_cast<std::uint32_t>(p[0]) | static_cast<std::uint32_t>(p[1]) << 8 |
         static_cast<std::uint32_t>(p[2]) << 16 | static_cast<std::uint32_t>(p[3]) << 24;
}
inline std::uint16_t GetU16(const std::uint8_t* p) {
  return static_cast<std::uint16_t>(p[0] | p[1] << 8);
}
inline std::int16_t GetI16(const std::uint8_t* p) { return static_cast<std::int16_t>(GetU16(p)); }
inline float GetFloat(const std::uint8_t* p) {
  const std::uint32_t bits = GetU32(p);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace zro::node
