#pragma once
// G8: the offset moves over days and months, whatever the temperature.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroAgeingInfo();

}  // namespace zrobench::physics
