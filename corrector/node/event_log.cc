#include "corrector/node/event_log.h"

#include <string.h>

#include "corrector/bytes.h"
#include "corrector/node/byte_writer.h"
#include "corrector/node/codec.h"
#include "corrector/node/crc16.h"

namespace zro::node {

void PackLogRecord(const Event& event, std::uint32_t t_us, std::uint8_t out[kLogRecordBytes]) {
  constexpr float kLsb = 1.0f / 256;
  ByteWriter w(out, kLogRecordBytes);
  w.Put(event.seq, 4);
  w.Put(t_us, 4);
  w.Put(static_cast<std::uint16_t>(ToWire16(event.temp_degc, kLsb)), 2);
  w.Put(static_cast<std::uint8_t>(event.code), 1);
  w.Put(static_cast<std::uint32_t>((event.axis & 3) << 6 | (event.bin & 63)), 1);
  for (float dps : event.measured_dps) w.Put(static_cast<std::uint16_t>(ToWire16(dps, kLsb)), 2);
  w.Put(ToWireU16(event.limit, kLsb), 2);
  w.Put(ToWireU16(event.value, kLsb), 2);
  w.Put(Crc16(out, kLogRecordBytes - 2), 2);
}

void EventLog::Put(const Event& event, std::uint32_t t_us) {
  PackLogRecord(event, t_us, ring_[put_ % kCapacity]);
  ++put_;
  if (read_ < first()) {
    lost_ += first() - read_;
    read_ = first();
  }
}

std::uint32_t EventLog::Peek(std::uint8_t out[kMaxRead * kLogRecordBytes]) const {
  const std::uint32_t unread = put_ - read_;
  const std::uint32_t n = unread < kMaxRead ? unread : kMaxRead;
  for (std::uint32_t i = 0; i < n; ++i) {
    memcpy(out + i * kLogRecordBytes, record(read_ + i), kLogRecordBytes);
  }
  return n;
}

void EventLog::Advance(std::uint32_t records) {
  const std::uint32_t unread = put_ - read_;
  read_ += records < unread ? records : unread;
}

void EventLog::SetCursor(std::uint32_t wanted) {
  read_ = first();
  while (read_ < put_ && seq(read_) < wanted) ++read_;
}

void EventLog::Clear() { put_ = read_ = lost_ = 0; }

std::uint32_t EventLog::seq(std::uint32_t n) const { return GetU32(record(n)); }
std::uint32_t EventLog::oldest() const { return put_ == 0 ? 0 : seq(first()); }
std::uint32_t EventLog::newest() const { return put_ == 0 ? 0 : seq(put_ - 1); }
std::uint32_t EventLog::cursor() const {
  if (read_ < put_) return seq(read_);
  return put_ == 0 ? 0 : newest() + 1;
}

}  // namespace zro::node
