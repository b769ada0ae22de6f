#pragma once
// The board's object dictionary. Freestanding.
//
// 0x1000      u32  ro  device type, 0
// 0x1001      u8   ro  error register: 0x81 after a rejection, until 0x1003:0 is written
// 0x1003:0    u8   rw  number of errors; writing 0 clears;  :1..8 u32 ro, newest first: EMCY code,
//                      low half of the event's number << 16
// 0x1008..A   str  ro  device name, hardware version, firmware version
// 0x1010:1,:4 u32  rw  "save": table to the store      0x1011:1,:4 "load": factory entries only
// 0x1017      u16  rw  heartbeat period [ms], 0 = none 0x1018:1..4 u32 ro vendor, product,
//                      revision (firmware), serial
// 0x2000      ro   :1 u16 layout version, :2 u16 entries, :7 u32 generation, :8 u32 CRC-32 of the
//                      canonical image, :10 u8 origin
// 0x2001      DOMAIN ro  canonical image (corrector/table.h); as frozen, else as of now
// 0x2004:1    u8   rw  1 freezes 0x2000 and 0x2001, 0 releases;  :2 u32 ro frozen generation
// 0x2005      DOMAIN wo  factory entries of 20 bytes: f32 temp_degc, zro_dps[3], sigma_dps;
//                      unlocked only; entries before one that is refused stay
// 0x2100:1..9 rw  limits (limit_objects.h)
// 0x2101:1    u32  rw  unlock (reads 1 when unlocked); :2 i16[3] rw rate injection,
//                      :6 u8 rw load of the board's own [%] (test_modes.h)
// 0x2200      :1 total, :2 lost, :3 oldest, :4 newest (u32 ro), :5 u32 wo "clrl" clears, :6 u32 rw
//                      read cursor (event_log.h)
// 0x2201      DOMAIN ro  up to 16 log records from the cursor on; it moves when they are read
#include <cstddef>
#include <cstdint>

#include "corrector/corrector.h"
#include "corrector/node/byte_writer.h"
#include "corrector/node/event_log.h"
#include "corrector/node/identity.h"
#include "corrector/node/sdo.h"
#include "corrector/node/table_image.h"
#include "corrector/node/test_modes.h"

namespace zro::node {

inline constexpr std::uint32_t kSaveSignature = 0x65766173;   ///< "save"
inline constexpr std::uint32_t kLoadSignature = 0x64616F6C;   ///< "load"
inline constexpr std::uint32_t kClearSignature = 0x6C726C63;  ///< "clrl"
inline constexpr std::size_t kFactoryEntryBytes = 20;

/// Where the dictionary's values live; all borrowed.
struct ObjectSources {
  const Identity* identity;
  Corrector* corrector;
  EventLog* log;
  TestModes* test_modes;
};

class ObjectDictionary final : public SdoObjects {
 public:
  explicit ObjectDictionary(const ObjectSources& sources) : from_(sources) {}

  const SdoObject* Find(std::uint16_t index, std::uint8_t sub, SdoAbort* abort) override;
  SdoAbort Read(std::uint16_t index, std::uint8_t sub, std::uint8_t* out, std::size_t capacity,
                std::size_t* size) override;
  SdoAbort Write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* bytes,
                 std::size_t size) override;
  void OnUploaded(std::uint16_t index, std::uint8_t sub) override;

  /// Notes an error in 0x1001 and 0x1003.
  void AddError(std::uint16_t emcy_code, std::uint32_t event_seq);
  std::uint8_t error_register() const { return errors_ > 0 ? 0x81 : 0; }  // generic | manufacturer
  std::uint16_t heartbeat_ms() const { return heartbeat_ms_; }

 private:
  static constexpr int kErrorHistory = 8;

  SdoAbort ReadIdentity(std::uint16_t index, std::uint8_t sub, ByteWriter* out) const;
  SdoAbort ReadErrors(std::uint8_t sub, ByteWriter* out) const;
  SdoAbort ReadTable(std::uint16_t index, std::uint8_t sub, ByteWriter* out);
  SdoAbort ReadTestModes(std::uint8_t sub, ByteWriter* out) const;
  SdoAbort ReadLog(std::uint16_t index, std::uint8_t sub, ByteWriter* out);
  SdoAbort WriteErrors(const std::uint8_t* bytes);
  SdoAbort WriteStore(std::uint16_t index, std::uint32_t signature);
  SdoAbort WriteFreeze(std::uint8_t command);
  SdoAbort WriteFactoryEntries(const std::uint8_t* bytes, std::size_t size);
  SdoAbort WriteLimit(std::uint8_t sub, const std::uint8_t* bytes);
  SdoAbort WriteTestModes(std::uint8_t sub, const std::uint8_t* bytes);
  SdoAbort WriteLog(std::uint8_t sub, std::uint32_t value);

  ObjectSources from_;
  std::uint16_t heartbeat_ms_ = 500;
  int errors_ = 0;
  std::uint32_t error_history_[kErrorHistory] = {};  // newest first
  bool frozen_ = false;
  TableImage image_;
  std::uint32_t offered_to_ = 0;  // log.passed() once the upload of 0x2201 under way is read
};

}  // namespace zro::node
