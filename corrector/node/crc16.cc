#include "corrector/node/crc16.h"

namespace zro::node {

std::uint16_t Crc16(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t crc = 0xFFFFu;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= static_cast<std::uint32_t>(bytes[i]) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc << 1) ^ ((crc & 0x8000u) ? 0x1021u : 0u);
  }
  return static_cast<std::uint16_t>(crc & 0xFFFFu);
}

}  // namespace zro::node
