#include "rig/run/settle.h"

#include <cmath>

namespace zrobench {

SettleDetector::SettleDetector(const SettleCriterion& criterion, double setpoint_degc,
                               Instant start)
    : criterion_(criterion), setpoint_degc_(setpoint_degc), start_(start) {}

void SettleDetector::Add(Instant t, double process_degc, std::optional<double> board_degc) {
  const bool in_band = std::abs(process_degc - setpoint_degc_) <= criterion_.band_degc;
  if (!in_band) {
    in_band_since_.reset();
  } else if (!in_band_since_) {
    in_band_since_ = t;
  }
  if (board_degc) window_.push_back({t, *board_degc});
  while (!window_.empty() && ToSeconds(t - window_.front().t) > criterion_.window_s) {
    window_.pop_front();
  }
  settled_ =
      in_band_since_ && ToSeconds(t - *in_band_since_) >= criterion_.window_s && SlopeIsSmall();
}

bool SettleDetector::timed_out(Instant t) const {
  return ToSeconds(t - start_) > criterion_.timeout_s;
}

bool SettleDetector::SlopeIsSmall() const {
  if (window_.size() < 3) return window_.empty();
  double mean_t = 0, mean_degc = 0;
  for (const Point& p : window_) {
    mean_t += ToSeconds(p.t - window_.front().t);
    mean_degc += p.degc;
  }
  const double n = static_cast<double>(window_.size());
  mean_t /= n;
  mean_degc /= n;
  double sxx = 0, sxy = 0;
  for (const Point& p : window_) {
    const double dt = ToSeconds(p.t - window_.front().t) - mean_t;
    sxx += dt * dt;
    sxy += dt * (p.degc - mean_degc);
  }
  return sxx > 0 && std::abs(sxy / sxx) * 60 <= criterion_.slope_degc_per_min;
}

}  // namespace zrobench
