#pragma once
// A4: while a tone excites the resonance, the rate shifts by a constant that grows with p^2.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo AcousticRectificationInfo();

}  // namespace zrobench::physics
