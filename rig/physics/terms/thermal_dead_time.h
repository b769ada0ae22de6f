#pragma once
// T10: the actuator follows its command late.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalDeadTimeInfo();

}  // namespace zrobench::physics
