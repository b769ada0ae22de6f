#pragma once
#include "rig/run/halt.h"

namespace zrobench {

/// SIGINT, SIGTERM and SIGHUP raise the level of the returned request: once = at the next safe
/// point, twice = now. One per program.
/// SIGPIPE and SIGXFSZ are ignored from here on.
StopRequest& CatchSignals();

}  // namespace zrobench
