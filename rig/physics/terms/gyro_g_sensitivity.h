#pragma once
// G13: the offset follows acceleration.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroGSensitivityInfo();

}  // namespace zrobench::physics
