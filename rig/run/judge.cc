#include "rig/run/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace zrobench {
namespace {

std::string Describe(const Measurement& m) {
  const std::string limit = m.value > m.high || !std::isfinite(m.low)
                                ? fmt::format("limit {:.4g}", m.high)
                                : (std::isfinite(m.high) && m.value >= m.low
                                       ? fmt::format("limits {:.4g} .. {:.4g}", m.low, m.high)
                                       : fmt::format("limit {:.4g}", m.low));
  const std::string uncertainty =
      m.uncertainty_k2 > 0 ? fmt::format(" +- {:.2g} (k=2)", m.uncertainty_k2) : "";
  const std::string unit = m.unit == "1" ? "" : " " + m.unit;
  return fmt::format("{} = {:.4g}{}{}, {}", m.name, m.value, uncertainty, unit, limit);
}

/// How far outside (positive) or inside (negative) its limits a value is.
double Excess(const Measurement& m) { return std::max(m.value - m.high, m.low - m.value); }

}  // namespace

Verdict Judge(const Measurement& m) {
  if (!std::isfinite(m.value) || !(m.uncertainty_k2 >= 0)) return Verdict::kInconclusive;
  const double excess = Excess(m);
  if (excess > 0) return excess > m.uncertainty_k2 ? Verdict::kFail : Verdict::kInconclusive;
  return excess + m.uncertainty_k2 > 0 ? Verdict::kMarginal : Verdict::kPass;
}

Verdict Worst(std::span<const Verdict> verdicts) {
  const auto worst = std::max_element(verdicts.begin(), verdicts.end());
  return worst == verdicts.end() ? Verdict::kInconclusive : *worst;
}

void JudgeCheck(CheckResult& result) {
  std::vector<Verdict> verdicts;
  const Measurement* worst = nullptr;
  Verdict worst_verdict = Verdict::kPass;
  for (const Measurement& m : result.measurements) {
    const Verdict verdict = Judge(m);
    verdicts.push_back(verdict);
    const bool further = worst == nullptr || verdict > worst_verdict ||
                         (verdict == worst_verdict && Excess(m) > Excess(*worst));
    if (further) {
      worst = &m;
      worst_verdict = verdict;
    }
  }
  result.verdict = Worst(verdicts);
  if (!result.reason.empty() || result.verdict == Verdict::kPass) return;
  result.reason = worst ? Describe(*worst) : "nothing was measured";
}

}  // namespace zrobench
