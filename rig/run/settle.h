#pragma once
// When is a soak settled? Process value in a band round the set point, and the board's temperature
// slope small, both for a whole window.
#include <deque>
#include <optional>

#include "core/clock.h"

namespace zrobench {

struct SettleCriterion {
  double band_degc = 0.3;           ///< |process value - set point|
  double slope_degc_per_min = 0.5;  ///< |d(board temperature)/dt|, least squares over the window
  double window_s = 20;
  double timeout_s = 1800;
};

/// Fed once a second or so; plain arithmetic, no clock of its own.
class SettleDetector {
 public:
  SettleDetector(const SettleCriterion& criterion, double setpoint_degc, Instant start);

  /// `board_degc` is absent while the board is silent: then the band alone decides.
  void Add(Instant t, double process_degc, std::optional<double> board_degc);
  bool settled() const { return settled_; }
  bool timed_out(Instant t) const;

 private:
  struct Point {
    Instant t;
    double degc;
  };
  bool SlopeIsSmall() const;

  SettleCriterion criterion_;
  double setpoint_degc_;
  Instant start_;
  std::optional<Instant> in_band_since_;
  std::deque<Point> window_;
  bool settled_ = false;
};

}  // namespace zrobench
