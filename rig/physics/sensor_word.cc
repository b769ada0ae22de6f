#include "rig/physics/sensor_word.h"

#include <cmath>
#include <limits>

#include "core/check.h"

namespace zrobench::physics {
namespace {

/// std::round for |x| <= 2^15, in line: x86-64 as it is built for has no instruction for it.
int RoundSmall(double x) {
  const int whole = static_cast<int>(x);
  const double rest = x - whole;  // exact
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

}  // namespace

SensorWord QuantiseToWord(double value, double lsb) {
  ZROBENCH_CHECK(lsb > 0);
  using Limits = std::numeric_limits<std::int16_t>;
  const double steps = value / lsb;
  if (std::isnan(steps)) return {0, true};
  if (steps >= Limits::max() + 0.5) return {Limits::max(), true};
  if (steps <= Limits::min() - 0.5) return {Limits::min(), true};
  return {static_cast<std::int16_t>(RoundSmall(steps)), false};
}

double Quantise(double value, double resolution) {
  ZROBENCH_CHECK(resolution >= 0);
  return resolution == 0 ? value : std::round(value / resolution) * resolution;
}

}  // namespace zrobench::physics
