#pragma once
// T14: the plate's sensor reads in another scale.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalPlateSensorGainInfo();

}  // namespace zrobench::physics
