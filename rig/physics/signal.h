#pragma once
// What the gyro shows at rest, without noise.
#include "rig/physics/model.h"

namespace zrobench::physics {

/// The zero-rate offset of each axis [dps]: the cubic in (die temperature - reference) [K].
Axes CubicOffset(const GyroModel& gyro, double die_degc);

}  // namespace zrobench::physics
