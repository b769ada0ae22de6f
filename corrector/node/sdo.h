#pragma once
// Service data objects (CiA 301, 7.2.4): what server and client share, and what a server serves.
#include <cstddef>
#include <cstdint>

namespace zro::node {

/// SDO abort codes (CiA 301, table 22) that this protocol uses.
enum class SdoAbort : std::uint32_t {
  kNone = 0,
  kToggle = 0x05030000,
  kTimeout = 0x05040000,
  kBadCommand = 0x05040001,
  kOutOfMemory = 0x05040005,
  kWriteOnly = 0x06010001,
  kReadOnly = 0x06010002,
  kNoObject = 0x06020000,
  kLength = 0x06070010,
  kNoSub = 0x06090011,
  kRange = 0x06090030,
  kCannotStore = 0x08000020,
  kWrongState = 0x08000022,
  kNoContent = 0x08000024,
};

enum class SdoAccess : std::uint8_t { kReadOnly, kReadWrite, kWriteOnly };

/// A row of an object dictionary: sub-indices first_sub..last_sub alike.
struct SdoObject {
  std::uint16_t index;
  std::uint8_t first_sub, last_sub;
  SdoAccess access;
  std::uint8_t size;  ///< bytes; 0 = any (DOMAIN, VISIBLE_STRING)
};

/// What an SDO server reads and writes. `sub` lies within the row that Find() gave.
class SdoObjects {
 public:
  /// The row, or null and why in `abort` (kNoObject, kNoSub).
  virtual const SdoObject* Find(std::uint16_t index, std::uint8_t sub, SdoAbort* abort) = 0;
  /// Copies the value, at most `capacity` bytes.
  virtual SdoAbort Read(std::uint16_t index, std::uint8_t sub, std::uint8_t* out,
                        std::size_t capacity, std::size_t* size) = 0;
  /// Takes a whole value at once; on failure nothing of a fixed-size object has changed.
  virtual SdoAbort Write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* bytes,
                         std::size_t size) = 0;
  /// The last byte of an upload is on its way.
  virtual void OnUploaded(std::uint16_t index, std::uint8_t sub) = 0;

 protected:
  ~SdoObjects() = default;
};

}  // namespace zro::node
