#pragma once
// G1: what a cubic lacks of the offset over temperature.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo GyroTemperatureCurveInfo();

}  // namespace zrobench::physics
