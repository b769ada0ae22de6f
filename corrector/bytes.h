#pragma once
// Little-endian numbers in byte buffers.
#include <string.h>

#include <cstdint>

namespace zro {

inline void PutU16(std::uint16_t value, std::uint8_t* out) {
  out[0] = static_cast<std::uint8_t>(value);
  out[1] = static_cast<std::uint8_t>(value >> 8);
}
inline void PutU32(std::uint32_t value, std::uint8_t* out) {
  for (int i = 0; i < 4; ++i) out[i] = static_cast<std::uint8_t>(value >> (8 * i));
}
inline std::uint16_t GetU16(const std::uint8_t* in) {
  return static_cast<std::uint16_t>(in[0] | (in[1] << 8));
}
inline std::uint32_t GetU32(const std::uint8_t* in) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(in[i]) << (8 * i);
  return value;
}
inline void PutFloat(float value, std::uint8_t* out) {
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  PutU32(bits, out);
}
inline float GetFloat(const std::uint8_t* in) {
  const std::uint32_t bits = GetU32(in);
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace zro
