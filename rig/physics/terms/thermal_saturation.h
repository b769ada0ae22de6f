#pragma once
// T11: the actuator gives less than it says.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalSaturationInfo();

}  // namespace zrobench::physics
