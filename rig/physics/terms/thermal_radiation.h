#pragma once
// T6: the plate radiates with the fourth power of temperature.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalRadiationInfo();

}  // namespace zrobench::physics
