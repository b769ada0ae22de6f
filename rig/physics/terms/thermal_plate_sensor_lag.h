#pragma once
// T13: the plate's sensor follows the plate slowly.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalPlateSensorLagInfo();

}  // namespace zrobench::physics
