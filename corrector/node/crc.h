#pragma once
// Checksums of the wire: table image (0x2000:8, DUT_IDENT) and log records (0x2201). Freestanding.
#include <cstddef>
#include <cstdint>

namespace zro::node {

/// CRC-32/ISO-HDLC: reflected 0xEDB88320, initial value and final xor 0xFFFFFFFF.
std::uint32_t Crc32(const std::uint8_t* bytes, std::size_t size);

/// CRC-16/CCITT-FALSE (CRC-16/IBM-3740): 0x1021, initial value 0xFFFF, not reflected.
std::uint16_t Crc16(const std::uint8_t* bytes, std::size_t size);

}  // namespace zro::node
