#pragma once
#include "rig/profile/profile.h"

namespace zrobench {

/// How long the profile should take [s], for a progress bar: ramps at their rate, soaks at a
/// typical plate's own pace. `start_degc`: plate temperature before the first step.
double NominalDurationS(const Profile& profile, double start_degc);
/// The same after each step, the first element being 0, before the first.
std::vector<double> StepEndsS(const Profile& profile, double start_degc);

}  // namespace zrobench
