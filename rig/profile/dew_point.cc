#include "rig/profile/dew_point.h"

#include <cmath>

#include "core/units.h"

namespace zrobench {

double DewPoint_degc(double ambient_degc, double humidity_pct) {
  if (!(humidity_pct > 0)) return -kKelvinOffset;
  constexpr double kA = 17.62, kB_degc = 243.12;
  const double gamma = std::log(humidity_pct / 100) + kA * ambient_degc / (kB_degc + ambient_degc);
  return kB_degc * gamma / (kA - gamma);
}

}  // namespace zrobench
