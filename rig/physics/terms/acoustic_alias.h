#pragma once
// A3: sound that moves the sense mass and is sampled as it is: folded by the output data rate it
// becomes a line, slow or even standing still when its frequency is near a multiple of that rate.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo AcousticAliasInfo();

}  // namespace zrobench::physics
