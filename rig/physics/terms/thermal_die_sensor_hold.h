#pragma once
// T15: the die's sensor is read now and then, and holds.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalDieSensorHoldInfo();

}  // namespace zrobench::physics
