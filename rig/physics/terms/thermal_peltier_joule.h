#pragma once
// T12: current heats the plate in either direction.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalPeltierJouleInfo();

}  // namespace zrobench::physics
