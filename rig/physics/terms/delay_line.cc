#include "rig/physics/terms/delay_line.h"

#include <algorithm>

namespace zrobench::physics {
namespace {

/// Four pieces fewer than there are: with the step's own length beside the delay, and the piece
/// that still grows, the past reaches far enough.
double ShortestPiece(double delay_s) { return delay_s / (DelayLine::kPieces - 4); }

}  // namespace

void DelayLine::Push(double value_now, double dt_s) {
  if (count() == kPieces) {
    std::copy(states_.begin() + 3, states_.end(), states_.begin() + 1);
    states_[0] -= 1;
  }
  value(count()) = value_now;
  duration_s(count()) = dt_s;
  states_[0] += 1;
}

void DelayLine::AppendHeld(double value_now, double dt_s, double delay_s) {
  if (count() > 0) {
    double& last = value(count() - 1);
    double& last_s = duration_s(count() - 1);
    // Before the first piece all was as it begins: it grows by its equals only.
    if (last == value_now || (count() > 1 && last_s < ShortestPiece(delay_s))) {
      if (last != value_now) last = (last * last_s + value_now * dt_s) / (last_s + dt_s);
      last_s += dt_s;
      return;
    }
  }
  Push(value_now, dt_s);
}

double DelayLine::MeanOfStep(double dt_s, double delay_s) const {
  double skip_s = delay_s, missing_s = dt_s, sum = 0;
  for (std::size_t i = count(); i-- > 0 && missing_s > 0;) {
    const double skipped_s = std::min(skip_s, duration_s(i));
    const double taken_s = std::min(missing_s, duration_s(i) - skipped_s);
    skip_s -= skipped_s;
    missing_s -= taken_s;
    sum += taken_s * value(i);
  }
  return (sum + missing_s * value(0)) / dt_s;
}

void DelayLine::AppendPoint(double value_now, double dt_s, double delay_s) {
  // The first piece is only where the line begins: it never grows.
  if (count() > 1 && duration_s(count() - 1) < ShortestPiece(delay_s)) {
    value(count() - 1) = value_now;
    duration_s(count() - 1) += dt_s;
    return;
  }
  Push(value_now, dt_s);
}

double DelayLine::At(double delay_s) const {
  double age_s = delay_s;
  for (std::size_t i = count(); i-- > 1;) {
    if (age_s <= duration_s(i)) {
      return value(i) + (value(i - 1) - value(i)) * age_s / duration_s(i);
    }
    age_s -= duration_s(i);
  }
  return value(0);
}

}  // namespace zrobench::physics
