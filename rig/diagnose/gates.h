#pragma once
#include <string>

#include "rig/diagnose/problem.h"

namespace zrobench::diagnose {

/// Why the data are unfit for physics, for people; empty when they are fit. A sensor that repeats
/// one value while others move, hardly any data, values no such sensor can give.
std::string UnfitBecause(const Problem& problem);

}  // namespace zrobench::diagnose
