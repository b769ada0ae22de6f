#pragma once
// T9: the board's own electronics warm it, and with it the die, above the plate.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalSelfHeatingInfo();

}  // namespace zrobench::physics
