#pragma once
// T5: air carries more than in proportion to the difference.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo ThermalConvectionInfo();

}  // namespace zrobench::physics
