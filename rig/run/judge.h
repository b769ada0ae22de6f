#pragma once
#include <span>

#include "rig/record/verdict.h"

namespace zrobench {

/// Judges one measured value against its limits: pass only when the value and its expanded
/// uncertainty (k = 2) lie inside; marginal when the value does but the uncertainty reaches a
/// limit; fail only when the value is outside by more than the uncertainty, else inconclusive
/// (decision rule with guard bands, after ISO 14253-1). NaN is inconclusive.
Verdict Judge(const Measurement& measurement);

/// The worst of them; kInconclusive when there is none.
Verdict Worst(std::span<const Verdict> verdicts);

/// Judges every measurement and sets verdict and, where it is not a pass, the reason: the worst
/// measurement in words. A reason already there (evidence missing) is kept.
void JudgeCheck(CheckResult& result);

}  // namespace zrobench
