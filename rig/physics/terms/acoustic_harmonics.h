#pragma once
// A6: the speaker plays multiples of its tone, too.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo AcousticHarmonicsInfo();

}  // namespace zrobench::physics
