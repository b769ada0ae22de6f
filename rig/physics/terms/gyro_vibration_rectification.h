#pragma once
// G14: vibration shifts the offset by its square.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroVibrationRectificationInfo();

}  // namespace zrobench::physics
