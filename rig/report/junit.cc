#include "rig/report/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "rig/record/utc_text.h"
#include "rig/report/figure.h"
#include "rig/report/markup.h"

namespace zrobench {
namespace {

/// From short to long; a check gets the first that no other check has.
std::vector<std::string> Candidates(const CheckResult& check) {
  std::vector<std::string> names{check.check};
  if (const auto during = check.about.rfind(" during "); during != std::string::npos) {
    names.push_back(check.check + check.about.substr(during));
  }
  names.push_back(check.check + ": " + check.about);
  return names;
}

bool SomebodyElseCouldBe(const std::string& name, const CheckResult& check,
                         const std::vector<CheckResult>& checks) {
  return std::any_of(checks.begin(), checks.end(), [&](const CheckResult& other) {
    const auto names = Candidates(other);
    return &other != &check && std::find(names.begin(), names.end(), name) != names.end();
  });
}

double EvidenceSeconds(const CheckResult& check) {
  if (check.measurements.empty()) return 0;
  std::uint64_t first = UINT64_MAX, last = 0;
  for (const Measurement& m : check.measurements) {
    first = std::min(first, m.first_us);
    last = std::max(last, m.last_us);
  }
  return last > first ? static_cast<double>(last - first) * 1e-6 : 0;
}

std::string Property(std::string_view name, std::string_view value) {
  return value.empty()
             ? ""
             : fmt::format("<property name=\"{}\" value=\"{}\"/>\n", Escaped(name), Escaped(value));
}

std::string MeasurementProperty(const Measurement& m) {
  std::string value = fmt::format("{:.6g}", m.value);
  if (m.unit != "1") value += " " + m.unit;
  value += ", limit " + LimitsText(m);
  value += m.uncertainty_k2 > 0 ? fmt::format(", uncertainty {:.2g} (k = 2)", m.uncertainty_k2)
                                : ", exact";
  return Property(m.name, value);
}

std::string Why(const CheckResult& check) {
  const Measurement* const worst = DecidingMeasurement(check);
  const std::string figure =
      worst ? fmt::format("{}: {} (limit {})", worst->name, ValueText(*worst), LimitsText(*worst))
            : "nothing was measured";
  return check.reason.empty() ? figure : check.reason + "; " + figure;
}

/// The element that says how it went; none for a clean pass.
std::string Outcome(const CheckResult& check) {
  const std::string why = Escaped(Why(check));
  const std::string about = Escaped(check.about);
  switch (check.verdict) {
    case Verdict::kPass:
      return "";
    case Verdict::kMarginal:
      return fmt::format("<system-out>marginal: {}</system-out>\n", why);
    case Verdict::kInconclusive:
      return fmt::format("<skipped message=\"inconclusive: {}\"/>\n", why);
    case Verdict::kFail:
      return fmt::format("<failure type=\"fail\" message=\"{}\">{}</failure>\n", why, about);
    case Verdict::kRigError:
      return fmt::format("<error type=\"rig_error\" message=\"{}\">{}</error>\n", why, about);
  }
  return "";
}

std::string Case(const CheckResult& check, const std::string& name, const std::string& suite) {
  std::string out =
      fmt::format("<testcase name=\"{}\" classname=\"{}\" time=\"{:.3f}\">\n", Escaped(name),
                  Escaped("zrobench." + suite), EvidenceSeconds(check));
  if (!check.measurements.empty()) {
    out += "<properties>\n";
    for (const Measurement& m : check.measurements) out += MeasurementProperty(m);
    out += "</properties>\n";
  }
  return out + Outcome(check) + "</testcase>\n";
}

/// A run that was cut short must not look green to a server that only counts failures.
std::vector<CheckResult> ChecksAndEnd(const RunManifest& manifest) {
  std::vector<CheckResult> checks = manifest.checks;
  if (manifest.ended && manifest.verdict && manifest.reason.empty()) return checks;
  CheckResult end;
  end.check = "run to its end";
  end.about = "the profile was driven to its end";
  end.verdict = Verdict::kRigError;
  end.reason = manifest.reason.empty() ? "the run did not end" : manifest.reason;
  checks.push_back(std::move(end));
  return checks;
}

std::string Counts(const std::vector<CheckResult>& checks) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(checks.begin(), checks.end(),
                         [&](const CheckResult& check) { return check.verdict == verdict; });
  };
  return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\"", checks.size(),
                     count(Verdict::kFail), count(Verdict::kRigError),
                     count(Verdict::kInconclusive));
}

std::string RunProperties(const RunManifest& m) {
  return "<properties>\n" + Property("station", m.station) + Property("backend", m.backend) +
         Property("seed", std::to_string(m.seed)) + Property("version", m.version) +
         Property("build", m.build) + Property("operator", m.operator_name) +
         Property("lot", m.lot) + Property("board_serial", m.board_serial) +
         Property("verdict", m.verdict ? VerdictName(*m.verdict) : "none") + "</properties>\n";
}

}  // namespace

std::vector<std::string> CaseNames(const std::vector<CheckResult>& checks) {
  std::vector<std::string> names;
  std::map<std::string, int> used;
  for (const CheckResult& check : checks) {
    const auto candidates = Candidates(check);
    const auto own = std::find_if(
        candidates.begin(), candidates.end(),
        [&](const std::string& name) { return !SomebodyElseCouldBe(name, check, checks); });
    std::string name = own == candidates.end() ? candidates.back() : *own;
    if (const int n = ++used[name]; n > 1) name += fmt::format(" ({})", n);
    names.push_back(std::move(name));
  }
  return names;
}

std::string JUnitXml(const RunManifest& manifest) {
  const std::vector<CheckResult> checks = ChecksAndEnd(manifest);
  const std::vector<std::string> names = CaseNames(checks);
  const double bench_s =
      manifest.ended ? static_cast<double>(*manifest.ended - manifest.started) * 1e-9 : 0;
  const std::string counts = Counts(checks);
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out += fmt::format("<testsuites name=\"zrobench\" {} time=\"{:.3f}\">\n", counts, bench_s);
  out +=
      fmt::format("<testsuite name=\"{}\" {} time=\"{:.3f}\" timestamp=\"{}\" hostname=\"{}\">\n",
                  Escaped(manifest.profile), counts, bench_s,
                  UtcText(manifest.started).substr(0, 19), Escaped(manifest.host));
  out += RunProperties(manifest);
  for (std::size_t i = 0; i < checks.size(); ++i) {
    out += Case(checks[i], names[i], manifest.profile);
  }
  return out + "</testsuite>\n</testsuites>\n";
}

}  // namespace zrobench
