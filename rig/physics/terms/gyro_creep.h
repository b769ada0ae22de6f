#pragma once
// G7: stress that relaxes after a step of temperature.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroCreepInfo();

}  // namespace zrobench::physics
