#pragma once
// G9: an offset that dies away after each power-on.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroWarmUpInfo();

}  // namespace zrobench::physics
