#pragma once
#include <cstddef>
#include <cstdint>

namespace zro {

/// CRC-32/ISO-HDLC (polynomial 0x04C11DB7 reflected, initial value and final xor 0xFFFFFFFF): the
/// CRC of the store's slots and of the table image on the bus. Check value of "123456789":
/// CBF43926.
std::uint32_t Crc32(const std::uint8_t* bytes, std::size_t size);

}  // namespace zro
