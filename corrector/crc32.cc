#include "corrector/crc32.h"

namespace zro {

std::uint32_t Crc32(const std::uint8_t* bytes, std::size_t size) {
  // Bit by bit: 1.2 kB are checked at boot and at a commit; a 1 kB table would cost more flash.
  std::uint32_t crc = 0xFFFFFFFFu;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

}  // namespace zro
