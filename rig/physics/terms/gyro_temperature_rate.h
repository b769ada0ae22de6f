#pragma once
// G6: the offset moves with how fast the temperature moves.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroTemperatureRateInfo();

}  // namespace zrobench::physics
