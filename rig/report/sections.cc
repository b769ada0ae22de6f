#include "rig/report/sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "rig/report/figure.h"
#include "rig/report/markup.h"

namespace zrobench {
namespace {

/// "20-22.5, 27.5-32.5 °C": neighbours that fit run together.
template <typename Fits>
std::string BinRanges(const std::vector<Coverage::Bin>& bins, Fits fits) {
  std::vector<std::string> ranges;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (!fits(bins[i])) continue;
    const double from_degc = bins[i].from_degc;
    while (i + 1 < bins.size() && fits(bins[i + 1])) ++i;
    ranges.push_back(fmt::format("{:g}–{:g}", from_degc, bins[i].to_degc));
  }
  return ranges.empty() ? "none" : fmt::format("{} °C", fmt::join(ranges, ", "));
}

/// ASCII signs as print has them.
std::string Typeset(std::string text) {
  for (const auto& [plain, sign] : {std::pair{"+-", "±"}, {"<=", "≤"}, {">=", "≥"}}) {
    if (const auto at = text.find(plain); at != std::string::npos) text.replace(at, 2, sign);
  }
  return Escaped(text);
}

std::string CodeText(std::size_t index) {
  const auto code = static_cast<zro::Code>(index + 1);
  return fmt::format("{}\u00a0{}", index + 1, CodeName(code));
}

std::string Defined(std::string_view term, std::string_view text) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, text);
}

/// Zero recedes, so that what was exercised is seen at a glance.
std::string CountCell(int count) {
  return count > 0 ? fmt::format("<td>{}</td>", count) : "<td class=\"nil\">0</td>";
}

std::string CodesIn(const Coverage::Bin& bin) {
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < bin.codes.size(); ++i) {
    if (bin.codes[i] > 0) seen.push_back(fmt::format("{} × {}", bin.codes[i], CodeText(i)));
  }
  return fmt::format("{}", fmt::join(seen, ", "));
}

std::string EntryText(const Coverage::Bin& bin) {
  if (bin.learned) return bin.factory ? "learned, factory" : "learned";
  return bin.factory ? "factory only" : "none";
}

std::string BinRow(const Coverage::Bin& bin) {
  std::string row = fmt::format("<tr><th scope=\"row\">{:g}–{:g}</th>", bin.from_degc, bin.to_degc);
  row += CountCell(bin.quiet_s) + CountCell(bin.accepted);
  for (const int refused : bin.refused) row += CountCell(refused);
  return row + fmt::format("<td class=\"text{}\">{}</td><td class=\"text\">{}</td></tr>\n",
                           bin.learned ? "" : " lack", EntryText(bin), CodesIn(bin));
}

std::string VerdictBadge(Verdict verdict) {
  const std::string_view name = VerdictName(verdict);
  return fmt::format("<span class=\"badge {0}\">{0}</span>", name);
}

}  // namespace

std::string ChecksHtml(const RunManifest& manifest) {
  if (manifest.checks.empty()) return "<p>No check was judged.</p>\n";
  std::string out =
      "<table class=\"checks\"><thead><tr><th>verdict</th><th>check</th><th>deciding figure</th>"
      "<th>limit</th><th>asked, and why it is no pass</th></tr></thead><tbody>\n";
  for (const CheckResult& check : manifest.checks) {
    const Measurement* const worst = DecidingMeasurement(check);
    out += fmt::format(
        "<tr><td>{}</td><th scope=\"row\">{}</th><td class=\"figure\">{}</td>"
        "<td class=\"figure\">{}</td><td>{}",
        VerdictBadge(check.verdict), Escaped(check.check), worst ? Typeset(ValueText(*worst)) : "–",
        worst ? Typeset(LimitsText(*worst)) : "–", Escaped(check.about));
    if (!check.reason.empty()) {
      out += fmt::format("<br><strong>{}</strong>", Escaped(check.reason));
    }
    out += "</td></tr>\n";
  }
  return out + "</tbody></table>\n";
}

std::string MeasurementsHtml(const RunManifest& manifest, const History& history) {
  const double start_us = static_cast<double>(history.start_us);
  std::string out =
      "<table><thead><tr><th class=\"text\">measurement</th><th>value ± k = 2</th><th>limit</th>"
      "<th>record [s]</th></tr></thead><tbody>\n";
  for (const CheckResult& check : manifest.checks) {
    for (const Measurement& m : check.measurements) {
      out += fmt::format(
          "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{:.1f} .. {:.1f}</td></tr>\n",
          Escaped(m.name), Typeset(ValueText(m)), Typeset(LimitsText(m)),
          (static_cast<double>(m.first_us) - start_us) * 1e-6,
          (static_cast<double>(m.last_us) - start_us) * 1e-6);
    }
  }
  return out + "</tbody></table>\n";
}

std::string NotExercisedHtml(const Coverage& coverage) {
  const auto& bins = coverage.bins;
  if (bins.empty()) return "<p>The record holds no set point: no bin can be named.</p>\n";
  std::vector<std::string> never, unblamed;
  for (std::size_t i = 0; i < coverage.codes.size(); ++i) {
    const auto& count = coverage.codes[i];
    if (count.expected + count.unexpected == 0) never.push_back(CodeText(i));
  }
  for (std::size_t a = 0; a < coverage.blamed.size(); ++a) {
    if (coverage.blamed[a] == 0) unblamed.emplace_back(1, "xyz"[a]);
  }
  std::string out =
      fmt::format("<p>Of {:g}–{:g} °C in bins of {:g} °C:</p>\n<dl>\n", bins.front().from_degc,
                  bins.back().to_degc, bins.front().to_degc - bins.front().from_degc);
  out += Defined("no learned entry", BinRanges(bins, [](const auto& b) { return !b.learned; }));
  out += Defined("no entry at all",
                 BinRanges(bins, [](const auto& b) { return !b.learned && !b.factory; }));
  out += Defined("no reading", BinRanges(bins, [](const auto& b) { return !b.any_reading(); }));
  out +=
      Defined("no second at rest", BinRanges(bins, [](const auto& b) { return b.quiet_s == 0; }));
  out += Defined("refusal codes never seen",
                 never.empty() ? "none" : fmt::format("{}", fmt::join(never, ", ")));
  out += Defined("axes never refused for",
                 unblamed.empty() ? "none" : fmt::format("{}", fmt::join(unblamed, ", ")));
  return out + "</dl>\n";
}

std::string CoverageHtml(const Coverage& coverage) {
  std::string out =
      "<table><thead><tr><th rowspan=\"2\" class=\"text\">bin [°C]</th><th rowspan=\"2\">at rest "
      "[s]</th>"
      "<th rowspan=\"2\">readings<br>accepted</th><th colspan=\"4\">refused, worst axis</th>"
      "<th rowspan=\"2\" class=\"text\">entry at the end</th>"
      "<th rowspan=\"2\" class=\"text\">refusal codes</th></tr>"
      "<tr><th>x</th><th>y</th><th>z</th><th>none</th></tr></thead><tbody>\n";
  for (const Coverage::Bin& bin : coverage.bins) out += BinRow(bin);
  out += "</tbody></table>\n<p>Refusals at any temperature: ";
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < coverage.codes.size(); ++i) {
    const auto& [expected, unexpected] = coverage.codes[i];
    if (expected + unexpected == 0) continue;
    seen.push_back(
        fmt::format("{} ({} expected, {} unexpected)", CodeText(i), expected, unexpected));
  }
  return out + (seen.empty() ? "none" : fmt::format("{}", fmt::join(seen, "; "))) + ".</p>\n";
}

}  // namespace zrobench
