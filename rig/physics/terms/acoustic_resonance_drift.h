#pragma once
// A2: the resonances move with temperature.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo AcousticResonanceDriftInfo();

}  // namespace zrobench::physics
