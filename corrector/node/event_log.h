#pragma once
// The board's decision log (objects 0x2200, 0x2201): every event of the corrector, codes 1..41, the
// last kCapacity of them, each a 24-byte record. Freestanding.
#include <cstddef>
#include <cstdint>

#include "corrector/types.h"

namespace zro::node {

inline constexpr std::size_t kLogRecordBytes = 24;

/// One event as its record: u32 seq, u32 t_us, i16 temperature (1/256 degC), u8 code,
/// u8 axis << 6 | bin, i16 measured[3] (1/256 dps), u16 limit, u16 value (1/256 of the unit of the
/// code's quantity), u16 CRC-16 of the 22 bytes before. Numbers out of range saturate.
void PackLogRecord(const Event& event, std::uint32_t t_us, std::uint8_t out[kLogRecordBytes]);

/// A ring of records and a read cursor. Records that are overwritten before they were read, and
/// events that never arrived here, count as lost. Starts empty at every boot.
class EventLog {
 public:
  static constexpr std::uint32_t kCapacity = 64;
  static constexpr std::uint32_t kMaxRead = 16;

  void Put(const Event& event, std::uint32_t t_us);
  /// Copies up to kMaxRead unread records, oldest first; returns how many. Moves nothing.
  std::uint32_t Peek(std::uint8_t out[kMaxRead * kLogRecordBytes]) const;
  /// The reader has got `records` of them.
  void Advance(std::uint32_t records);
  /// The next record to read is the first whose seq is not below `seq`.
  void SetCursor(std::uint32_t seq);
  /// Drops the records and the counts.
  void Clear();

  std::uint32_t total() const { return put_; }  ///< records put since boot or Clear()
  std::uint32_t lost() const { return lost_; }
  std::uint32_t passed() const { return read_; }  ///< of them, read or lost
  std::uint32_t oldest() const;  ///< seq of the oldest record kept; 0 when there is none
  std::uint32_t newest() const;
  std::uint32_t cursor() const;  ///< seq of the next record to read; newest() + 1 when all are read

 private:
  std::uint32_t first() const { return put_ > kCapacity ? put_ - kCapacity : 0; }
  const std::uint8_t* record(std::uint32_t n) const { return ring_[n % kCapacity]; }
  std::uint32_t seq(std::uint32_t n) const;

  std::uint8_t ring_[kCapacity][kLogRecordBytes] = {};
  std::uint32_t put_ = 0;   // record n lies in ring_[n % kCapacity]
  std::uint32_t read_ = 0;  // n of the next one to read
  std::uint32_t lost_ = 0;
};

}  // namespace zro::node
