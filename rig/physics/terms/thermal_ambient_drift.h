#pragma once
// T7: the room warms while the run goes on.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalAmbientDriftInfo();

}  // namespace zrobench::physics
