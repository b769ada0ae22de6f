#pragma once
// G15: the offset moves with the supply voltage.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroSupplyInfo();

}  // namespace zrobench::physics
