#include "rig/physics/signal.h"

namespace zrobench::physics {

Axes CubicOffset(const GyroModel& gyro, double die_degc) {
  const double x = die_degc - gyro.reference_degc;
  Axes offset_dps{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& c = gyro.zro_dps[axis];
    offset_dps[axis] = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
  }
  return offset_dps;
}

}  // namespace zrobench::physics
