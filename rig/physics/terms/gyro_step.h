#pragma once
// G19: the offset jumps once and stays.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroStepInfo();

}  // namespace zrobench::physics
