#pragma once
// G3: gaps of several widths, a Prandtl-Ishlinskii operator.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroHysteresisInfo();

}  // namespace zrobench::physics
