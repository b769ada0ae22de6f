#pragma once
// ULog version 1 (PX4 user guide, "ULog File Format"), the part of it that a record uses.
// A file is a header and messages {u16 size, u8 type, size bytes}, little endian, append-only.
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zrobench::ulog {

static_assert(std::endian::native == std::endian::little, "records are packed with memcpy");

inline constexpr std::array<std::uint8_t, 8> kMagic = {0x55, 0x4C, 0x6F, 0x67,
                                                       0x01, 0x12, 0x35, 0x01};
inline constexpr std::array<std::uint8_t, 8> kSyncMagic = {0x2F, 0x73, 0x13, 0x20,
                                                           0x25, 0x0C, 0xBB, 0x12};
inline constexpr std::size_t kHeaderBytes = 16;        ///< magic, then u64 start [us]
inline constexpr std::size_t kMessageHeaderBytes = 3;  ///< u16 size, u8 type
inline constexpr std::size_t kMaxMessageBytes = 65535;
inline constexpr std::size_t kFlagBitsBytes = 40;

/// One field of a format, where it lies in the packed data message (after the u16 message id).
struct Field {
  std::string type;  ///< element type, "int16_t"
  std::string name;
  std::size_t count = 1;
  std::size_t offset = 0;
  std::size_t bytes = 0;  ///< of all elements
};

/// An 'F' message: name and fields in file order.
struct Format {
  std::string name;
  std::vector<Field> fields;
  std::size_t bytes = 0;  ///< of one data message, its id not counted
};

/// Bytes of a basic type, 0 for an unknown (or nested) one.
std::size_t TypeBytes(std::string_view type);

/// Parses "name:type[n] field;type field;". Nothing when malformed or of nested types.
std::optional<Format> ParseFormat(std::string_view text);

}  // namespace zrobench::ulog
