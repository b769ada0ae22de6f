#pragma once
// B4: the die's temperature is labelled late.
#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo TimeLatencyInfo();

}  // namespace zrobench::physics
