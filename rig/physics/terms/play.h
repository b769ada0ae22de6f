#pragma once
// The play operator: backlash, as of two gears that touch only after a gap has closed.
#include <algorithm>
#include <cmath>
#include <limits>

namespace zrobench::physics {

/// A play that has not moved since power-on; takes the first input as its position.
inline constexpr double kPlayAtRest = std::numeric_limits<double>::quiet_NaN();

/// Where a play of half-width `w` stands after its input came to `input`.
inline double MovedPlay(double play, double input, double w) {
  return std::isnan(play) ? input : std::clamp(play, input - w, input + w);
}

}  // namespace zrobench::physics
