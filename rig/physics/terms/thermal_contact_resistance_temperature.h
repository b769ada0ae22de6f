#pragma once
// T2: board and plate touch better or worse when warm.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalContactResistanceTemperatureInfo();

}  // namespace zrobench::physics
