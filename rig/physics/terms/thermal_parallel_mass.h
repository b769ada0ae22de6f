#pragma once
// T4: a mass beside the heat's path that warms slowly: connector, cable, fixture.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalParallelMassInfo();

}  // namespace zrobench::physics
