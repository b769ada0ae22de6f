#include "rig/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kIndent = 34;  ///< where a check's second line begins

/// Breaks `text` at blanks so that lines fit, each new one indented.
std::string Wrapped(const std::string& text, std::size_t indent) {
  std::string out(indent, ' ');
  std::size_t column = indent;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t length = end - begin;
    if (column > indent && column + 1 + length > kColumns) {
      out += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      out += ' ';
      ++column;
    }
    out.append(text, begin, length);
    column += length;
    begin = end + 1;
  }
  return out + '\n';
}

std::string Limits(const Measurement& m) {
  if (std::isfinite(m.low) && std::isfinite(m.high)) {
    return fmt::format("{:g} .. {:g}", m.low, m.high);
  }
  if (std::isfinite(m.high)) return fmt::format("<= {:g}", m.high);
  return std::isfinite(m.low) ? fmt::format(">= {:g}", m.low) : "none";
}

std::string Uncertainty(const Measurement& m) {
  return m.uncertainty_k2 > 0 ? fmt::format(" +- {:.2g}", m.uncertainty_k2) : "";
}

std::string Unit(const Measurement& m) { return m.unit == "1" ? "" : " " + m.unit; }

/// How near to (negative) or beyond its nearer limit, as a share of the limit's size.
double Closeness(const Measurement& m) {
  const double span = std::isfinite(m.low) && std::isfinite(m.high) ? (m.high - m.low) / 2
                      : std::isfinite(m.high)                       ? std::abs(m.high)
                                                                    : std::abs(m.low);
  return std::max(m.value - m.high, m.low - m.value) / std::max(span, 1e-9);
}

/// The figure nearest to its limit: what the check hung on.
std::string Figure(const CheckResult& check) {
  const auto worst = std::max_element(
      check.measurements.begin(), check.measurements.end(),
      [](const Measurement& a, const Measurement& b) { return Closeness(a) < Closeness(b); });
  if (worst == check.measurements.end()) return "-";
  return fmt::format("{:.4g}{}{} (limit {})", worst->value, Uncertainty(*worst), Unit(*worst),
                     Limits(*worst));
}

std::string CheckLines(const CheckResult& check) {
  std::string out =
      fmt::format("  {:<13} {:<17} {}\n", VerdictName(check.verdict), check.check, Figure(check));
  if (!check.about.empty()) out += Wrapped(check.about, kIndent);
  if (!check.reason.empty()) out += Wrapped("why: " + check.reason, kIndent);
  return out;
}

constexpr std::size_t kShownAlarms = 8;

std::string AlarmLines(const std::vector<std::string>& alarms) {
  if (alarms.empty()) return {};
  std::string out = fmt::format("\n{} alarm{} of the rig during the run\n", alarms.size(),
                                alarms.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(alarms.size(), kShownAlarms); ++i) {
    out += Wrapped("- " + alarms[i], 2);
  }
  if (alarms.size() > kShownAlarms) {
    out += fmt::format("  ... and {} more in the record\n", alarms.size() - kShownAlarms);
  }
  return out;
}

std::string MeasurementLine(const Measurement& m) {
  const std::string figure = fmt::format("{:.4g}{}{}", m.value, Uncertainty(m), Unit(m));
  return fmt::format("  {:<34} {:<22} limit {:<13} {:>6.0f} .. {:.0f} s\n", m.name, figure,
                     Limits(m), static_cast<double>(m.first_us) * 1e-6,
                     static_cast<double>(m.last_us) * 1e-6);
}

}  // namespace

std::string CountLine(const RunManifest& manifest) {
  const CheckCounts counts = CountChecks(manifest.checks);
  return fmt::format("{} passed, {} failed, {} skipped", counts.passed, counts.failed,
                     counts.skipped);
}

std::string VerdictTable(const RunManifest& manifest, const std::vector<std::string>& alarms) {
  std::string out = fmt::format("{} on {} ({}), seed {}\n\n", manifest.profile, manifest.station,
                                manifest.backend, manifest.seed);
  out += fmt::format("  {:<13} {:<17} {}\n", "verdict", "check", "deciding figure");
  for (const CheckResult& check : manifest.checks) out += CheckLines(check);
  out += AlarmLines(alarms);
  out +=
      fmt::format("\nverdict: {}{}\n",
                  manifest.verdict ? VerdictName(*manifest.verdict) : "none: the run did not end",
                  alarms.empty() ? "" : ", with alarms");
  if (!manifest.reason.empty()) out += Wrapped("ended early: " + manifest.reason, 0);
  return out;
}

std::string FullReport(const RunManifest& manifest, const std::vector<std::string>& alarms) {
  std::string out = VerdictTable(manifest, alarms);
  out += fmt::format("\nstarted {}, software {} ({})\n\nmeasurements (uncertainty: k = 2)\n",
                     UtcText(manifest.started), manifest.version, manifest.build);
  for (const CheckResult& check : manifest.checks) {
    for (const Measurement& m : check.measurements) out += MeasurementLine(m);
  }
  return out;
}

}  // namespace zrobench
