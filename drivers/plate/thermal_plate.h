#pragma once
#include "core/clock.h"
#include "core/result.h"

namespace zrobench {

/// A thermal plate that can be told a temperature and asked for one.
/// Implemented by VirtualPlate (rig/virtual); contract test: tests/contract.
/// Thread-compatible. Every call returns by `deadline`.
class ThermalPlate {
 public:
  struct Reading {
    double process_degc = 0;   ///< measured plate temperature
    double setpoint_degc = 0;  ///< as read back from the plate, not as last sent
    double drive_pct = 0;      ///< heater (+) or cooler (-), -100..100
    Instant at{};              ///< midpoint of request and reply
  };

  virtual ~ThermalPlate() = default;
  virtual Result<Reading> Read(Instant deadline) = 0;
  /// Writes the set point, turns the output on and confirms by read-back. Values outside the
  /// plate's own limits: kLimit, nothing written.
  virtual Status SetTarget(double degc, Instant deadline) = 0;
  /// Output off. Idempotent.
  virtual Status MakeSafe(Instant deadline) = 0;
};

}  // namespace zrobench
