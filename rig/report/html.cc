#include "rig/report/html.h"

#include <fmt/format.h>

#include <algorithm>

#include "rig/record/utc_text.h"
#include "rig/report/markup.h"
#include "rig/report/plots.h"
#include "rig/report/sections.h"
#include "rig/report/text.h"
#include "rig/report/web_assets.h"

namespace zrobench {
namespace {

constexpr std::size_t kShownAlarms = 5;

std::string Notice(std::string_view text) {
  return text.empty() ? "" : fmt::format("<p class=\"notice\">{}</p>\n", Escaped(text));
}

/// What a reader must know before believing the rest: an early end, a cut record, alarms.
std::string Notices(const RunManifest& manifest, const History& history) {
  std::string out;
  if (!manifest.reason.empty()) out += Notice("ended early: " + manifest.reason);
  if (!history.damage.empty()) {
    const std::string table =
        history.table_s < 0 ? "the board's table was never read"
                            : fmt::format("entries are those read at {:.1f} s", history.table_s);
    out += Notice(fmt::format("the record ends early: {}; {}", history.damage, table));
  }
  for (std::size_t i = 0; i < std::min(history.alarms.size(), kShownAlarms); ++i) {
    out += Notice(fmt::format("alarm of the rig at {:.1f} s: {}", history.alarms[i].t_s,
                              history.alarms[i].text));
  }
  if (history.alarms.size() > kShownAlarms) {
    out +=
        Notice(fmt::format("{} more alarms in the record", history.alarms.size() - kShownAlarms));
  }
  return out;
}

std::string Line(std::string_view what, std::string_view value) {
  return value.empty() ? "" : fmt::format(" · {} {}", what, Escaped(value));
}

std::string Stamp(const RunManifest& m, const History& history) {
  std::string out = fmt::format("{} on {} ({}) · seed {} · {} · {:.0f} s of bench time",
                                Escaped(m.profile), Escaped(m.station), Escaped(m.backend), m.seed,
                                UtcText(m.started).substr(0, 19) + "Z", history.duration_s);
  return out + Line("operator", m.operator_name) + Line("lot", m.lot) +
         Line("board", m.board_serial) + Line("software", m.version);
}

}  // namespace

std::string HtmlReport(const RunManifest& manifest, const History& history) {
  const Coverage coverage = CoverageOf(history);
  const std::string_view verdict = manifest.verdict ? VerdictName(*manifest.verdict) : "none";
  using fmt::arg;
  return fmt::format(
      fmt::runtime(web::kReportHtml), arg("title", Escaped(manifest.profile)),
      arg("verdict", verdict), arg("counts", CountLine(manifest)),
      arg("stamp", Stamp(manifest, history)), arg("notices", Notices(manifest, history)),
      arg("checks", ChecksHtml(manifest)), arg("not_exercised", NotExercisedHtml(coverage)),
      arg("coverage", CoverageHtml(coverage)), arg("tones", TonesHtml(history)),
      arg("refusals", RefusalsHtml(history)),
      arg("measurements", MeasurementsHtml(manifest, history)), arg("plots", PlotsJson(history)),
      arg("library_css", web::kDygraphCss), arg("css", web::kReportCss),
      arg("library_js", web::kDygraphJs), arg("js", web::kReportJs));
}

}  // namespace zrobench
