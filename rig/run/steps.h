#pragma once
// What each kind of step does with the bench. Blocking (in clock time) until the step is over.
#include <string>

#include "rig/profile/profile.h"
#include "rig/run/bench_loop.h"

namespace zrobench {

Flow RunStep(BenchLoop& loop, const Soak& soak);
Flow RunStep(BenchLoop& loop, const Ramp& ramp);
Flow RunStep(BenchLoop& loop, const Hold& hold);
Flow RunStep(BenchLoop& loop, const Tone& tone);
Flow RunStep(BenchLoop& loop, const Move& move);
Flow RunStep(BenchLoop& loop, const PowerCycle& cycle);
Flow RunStep(BenchLoop& loop, const DateStep& date);
Flow RunStep(BenchLoop& loop, const Music& music);
Flow RunStep(BenchLoop& loop, const Sweep& sweep);
Flow RunStep(BenchLoop& loop, const Load& load);

/// "ramp to 42 degC at 4 degC/min": for records and progress.
std::string DescribeStep(const Action& action);

}  // namespace zrobench
