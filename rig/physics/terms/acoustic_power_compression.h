#pragma once
// A7: the speaker gets quieter as its coil warms.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo AcousticPowerCompressionInfo();

}  // namespace zrobench::physics
