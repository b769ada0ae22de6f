#pragma once
// What a plate's own controller does between set point and drive: a PI loop with a set-point rate
// limit and anti-windup, as benches' Modbus controllers have.
#include "rig/station/station.h"

namespace zrobench {

class PlateController {
 public:
  explicit PlateController(const VirtualSettings& settings) : settings_(settings) {}

  /// Output on, towards `setpoint_degc`. `process_degc` is where the working set point starts.
  void Start(double setpoint_degc, double process_degc);
  void Stop();
  /// One control period. Returns the drive [%], -100..100; 0 when stopped.
  double Step(double process_degc, double dt_s);

  bool on() const { return on_; }
  double setpoint_degc() const { return setpoint_degc_; }
  double drive_pct() const { return drive_pct_; }

 private:
  VirtualSettings settings_;
  bool on_ = false;
  double setpoint_degc_ = 0;
  double working_degc_ = 0;  ///< rate-limited set point
  double integral_pct_ = 0;
  double drive_pct_ = 0;
};

}  // namespace zrobench
