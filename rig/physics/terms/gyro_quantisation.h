#pragma once
// G20: rates in steps too coarse for their noise.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroQuantisationInfo();

}  // namespace zrobench::physics
