#include "rig/report/text.h"

#include <fmt/format.h>

#include <algorithm>

#include "rig/record/utc_text.h"
#include "rig/report/figure.h"

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

/// The figure nearest to its limit: what the check hung on.
std::string Figure(const CheckResult& check) {
  const Measurement* deciding = DecidingMeasurement(check);
  if (deciding == nullptr) return "-";
  return fmt::format("{} (limit {})", ValueText(*deciding), LimitsText(*deciding));
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
  return fmt::format("  {:<34} {:<22} limit {:<13} {:>6.0f} .. {:.0f} s\n", m.name, ValueText(m),
                     LimitsText(m), static_cast<double>(m.first_us) * 1e-6,
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
