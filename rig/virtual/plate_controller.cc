#include "rig/virtual/plate_controller.h"

#include <algorithm>
#include <cmath>

namespace zrobench {

void PlateController::Start(double setpoint_degc, double process_degc) {
  if (!on_) {
    on_ = true;
    working_degc_ = process_degc;
    integral_pct_ = 0;
  }
  setpoint_degc_ = setpoint_degc;
}

void PlateController::Stop() {
  on_ = false;
  drive_pct_ = 0;
}

double PlateController::Step(double process_degc, double dt_s) {
  if (!on_) return drive_pct_ = 0;
  const double limit = settings_.rate_limit_degc_per_min / 60.0 * dt_s;
  const double wanted = setpoint_degc_ - working_degc_;
  working_degc_ += limit > 0 ? std::clamp(wanted, -limit, limit) : wanted;

  const double error = working_degc_ - process_degc;
  const double unlimited = settings_.kp_pct_per_k * error + integral_pct_;
  drive_pct_ = std::clamp(unlimited, -100.0, 100.0);
  const bool winding_up = unlimited != drive_pct_ && error * unlimited > 0;
  if (!winding_up) integral_pct_ += settings_.ki_pct_per_k_s * error * dt_s;
  return drive_pct_;
}

}  // namespace zrobench
