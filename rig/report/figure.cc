#include "rig/report/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zrobench {
namespace {

/// How near to (negative) or beyond its nearer limit, as a share of the limit's size.
double Closeness(const Measurement& m) {
  const double span = std::isfinite(m.low) && std::isfinite(m.high) ? (m.high - m.low) / 2
                      : std::isfinite(m.high)                       ? std::abs(m.high)
                                                                    : std::abs(m.low);
  return std::max(m.value - m.high, m.low - m.value) / std::max(span, 1e-9);
}

}  // namespace

std::string LimitsText(const Measurement& m) {
  if (std::isfinite(m.low) && std::isfinite(m.high)) {
    return fmt::format("{:g} .. {:g}", m.low, m.high);
  }
  if (std::isfinite(m.high)) return fmt::format("<= {:g}", m.high);
  return std::isfinite(m.low) ? fmt::format(">= {:g}", m.low) : "none";
}

std::string ValueText(const Measurement& m) {
  std::string text = fmt::format("{:.4g}", m.value);
  if (m.uncertainty_k2 > 0) text += fmt::format(" +- {:.2g}", m.uncertainty_k2);
  if (m.unit != "1") text += " " + m.unit;
  return text;
}

const Measurement* DecidingMeasurement(const CheckResult& check) {
  const auto worst = std::max_element(
      check.measurements.begin(), check.measurements.end(),
      [](const Measurement& a, const Measurement& b) { return Closeness(a) < Closeness(b); });
  return worst == check.measurements.end() ? nullptr : &*worst;
}

}  // namespace zrobench
