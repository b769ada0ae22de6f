#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "corrector/table.h"
#include "drivers/link/can_bus.h"

namespace zrobench {

/// Sees every frame of the bus, in bus order, own ones included: the recorder's tap.
class FrameListener {
 public:
  virtual ~FrameListener() = default;
  virtual void OnFrame(const CanFrame& frame) = 0;
};

/// A consistent snapshot of the board's table (objects 0x2000, 0x2001 under 0x2004).
struct TableSnapshot {
  std::vector<std::uint8_t> image;  ///< canonical image (corrector/table.h)
  std::uint32_t crc32 = 0;          ///< as the board states it; verified against `image`
  std::uint32_t generation = 0;
  zro::Table table;  ///< the image, parsed
};

/// One 24-byte record of the board's decision log (object 0x2201), parsed and CRC-checked.
struct LogRecord {
  std::uint32_t seq = 0;
  std::uint32_t t_us = 0;  ///< device time
  zro::Code code = zro::Code::kNone;
  std::uint8_t axis = zro::kNoAxis;
  std::uint8_t bin = zro::kNoBin;
  double temp_degc = 0;
  std::array<double, 3> measured_dps{};
  double limit = 0;  ///< unit of the code's quantity, see zro::Event
  double value = 0;
};

/// Parses one raw 24-byte log record; kProtocol when its CRC-16 is wrong.
Result<LogRecord> ParseLogRecord(std::span<const std::uint8_t, 24> bytes);

struct BoardStatus {
  bool alive = false;  ///< a heartbeat or data within the last 1.5 s
  std::uint16_t boot_count = 0;
  std::uint32_t boots_seen = 0;     ///< boot-up messages since this object was made
  std::uint64_t samples = 0;        ///< DUT_RAW frames received
  std::uint64_t sequence_gaps = 0;  ///< samples missing between consecutive DUT_RAW
  std::uint64_t emcy = 0;
};

/// An IMU board that runs the corrector. Implemented by CanImuBoard over any CanBus.
/// Thread-compatible. Calls with a deadline wait through the Clock and keep pumping the bus.
class ImuBoard {
 public:
  virtual ~ImuBoard() = default;

  /// Takes every frame waiting on the bus and shows it to the listener. Never blocks. kTime when a
  /// frame is older than the one before it; kClosed when the bus is gone.
  virtual Status Pump() = 0;
  virtual BoardStatus status() const = 0;
  virtual CanHealth link() const = 0;

  /// NMT reset node: the board reboots (boots_seen grows when it is back).
  virtual Status Reset() = 0;
  /// Sends the CiA 301 TIME_STAMP (0x100) for this wall time: the date of new entries.
  virtual Status SendDate(UtcNs utc) = 0;
  /// Producer heartbeat of the rig; call at least every 0.5 s while test modes are in use.
  virtual Status SendHeartbeat() = 0;

  virtual Result<TableSnapshot> ReadTable(Instant deadline) = 0;
  /// Raw 24-byte records newer than the last call's, oldest first; advances the read cursor.
  virtual Result<std::vector<std::array<std::uint8_t, 24>>> ReadNewLogRecords(Instant deadline) = 0;
  virtual Status StoreTable(Instant deadline) = 0;
  virtual Status RestoreFactory(Instant deadline) = 0;
  virtual Status DownloadFactoryEntry(double temp_degc, const std::array<double, 3>& zro_dps,
                                      double sigma_dps, Instant deadline) = 0;
  /// Lets the board warm itself by its own work, `duty_pct` 0..100 of its time (object 0x2101:6),
  /// for as long as heartbeats come; 0 ends it, and the board's test modes with it. kRefused where
  /// a board has no such load.
  virtual Status SetLoad(double duty_pct, Instant deadline) = 0;
};

}  // namespace zrobench
