#pragma once
// The checksum of log records (object 0x2201). Freestanding.
#include <cstddef>
#include <cstdint>

namespace zro::node {

/// CRC-16/CCITT-FALSE (CRC-16/IBM-3740): 0x1021, initial value 0xFFFF, not reflected.
std::uint16_t Crc16(const std::uint8_t* bytes, std::size_t size);

}  // namespace zro::node
