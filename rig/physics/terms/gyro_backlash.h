#pragma once
// G2: the offset follows the temperature through a gap.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroBacklashInfo();

}  // namespace zrobench::physics
