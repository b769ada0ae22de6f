#include "rig/physics/sensor_word.h"

#include <cmath>
#include <limits>

#include "core/check.h"

namespace zrobench::physics {

SensorWord QuantiseToWord(double value, double lsb) {
  ZROBENCH_CHECK(lsb > 0);
  using Limits = std::numeric_limits<std::int16_t>;
  const double steps = std::round(value / lsb);
  if (std::isnan(steps)) return {0, true};
  if (steps > Limits::max()) return {Limits::max(), true};
  if (steps < Limits::min()) return {Limits::min(), true};
  return {static_cast<std::int16_t>(steps), false};
}

double Quantise(double value, double resolution) {
  ZROBENCH_CHECK(resolution >= 0);
  return resolution == 0 ? value : std::round(value / resolution) * resolution;
}

}  // namespace zrobench::physics
