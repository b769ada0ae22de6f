#pragma once
// T3: a second mass in the heat's path to the die: lid, potting.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalSeriesMassInfo();

}  // namespace zrobench::physics
