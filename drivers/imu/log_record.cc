#include <fmt/format.h>

#include "corrector/bytes.h"
#include "corrector/node/crc16.h"
#include "drivers/imu/imu_board.h"

namespace zrobench {

// Layout: zro::node::PackLogRecord (corrector/node/event_log.h).
Result<LogRecord> ParseLogRecord(std::span<const std::uint8_t, 24> bytes) {
  constexpr double kLsb = 1.0 / 256;
  const std::uint8_t* p = bytes.data();
  const auto signed_at = [p](int offset) {
    return kLsb * static_cast<std::int16_t>(zro::GetU16(p + offset));
  };
  const std::uint16_t crc = zro::node::Crc16(p, 22);
  if (crc != zro::GetU16(p + 22)) {
    return Fail(Error::Kind::kProtocol,
                fmt::format("board log record {}: CRC-16 {:04X}, not {:04X}", zro::GetU32(p),
                            zro::GetU16(p + 22), crc));
  }
  LogRecord r;
  r.seq = zro::GetU32(p);
  r.t_us = zro::GetU32(p + 4);
  r.temp_degc = signed_at(8);
  r.code = static_cast<zro::Code>(p[10]);
  r.axis = p[11] >> 6;
  r.bin = p[11] & 63;
  r.measured_dps = {signed_at(12), signed_at(14), signed_at(16)};
  r.limit = kLsb * zro::GetU16(p + 18);
  r.value = kLsb * zro::GetU16(p + 20);
  return r;
}

}  // namespace zrobench
