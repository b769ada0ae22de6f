#pragma once
// B5: the plate's register is filled now and then, and holds.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo TimeSampleHoldInfo();

}  // namespace zrobench::physics
