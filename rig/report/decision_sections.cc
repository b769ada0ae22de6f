#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/report/markup.h"
#include "rig/report/sections.h"

namespace zrobench {
namespace {

constexpr std::size_t kShownRefusals = 400;  ///< the record has them all

/// What value and limit of a refusal are, by code (corrector/README.md); two where the code has
/// two tests.
std::string_view QuantityOf(zro::Code code) {
  switch (code) {
    case zro::Code::kMotion:
      return "acceleration scatter [g] or turn [dps]";
    case zro::Code::kGyroVariance:
      return "noise ÷ floor, or drift [dps]";
    case zro::Code::kBiasLimit:
      return "offset [dps]";
    case zro::Code::kDiffersFromEntry:
      return "difference from entry [dps]";
    case zro::Code::kTemperatureSlope:
      return "slope [°C/s]";
    case zro::Code::kTemperatureRange:
      return "temperature [°C]";
    case zro::Code::kTemperatureSensor:
      return "bad values, or jump [°C]";
    case zro::Code::kTooShort:
      return "length [s]";
    case zro::Code::kClipped:
    case zro::Code::kSampleGap:
      return "samples";
    case zro::Code::kAcousticOrVibration:
      return "noise ÷ floor";
    case zro::Code::kDiffersFromEstimate:
      return "difference from estimate [dps]";
    default:
      return "";
  }
}

/// "tone 27000 Hz 100 dB".
std::string StimulusText(const History::Stimulus& s) {
  std::string text = s.kind;
  if (s.hz > 0) text += fmt::format(" {:g} Hz", s.hz);
  if (s.spl_db > 0) text += fmt::format(" {:g} dB", s.spl_db);
  return text;
}

/// "0.801", "–" where nothing was averaged yet (the log then holds zeros).
std::string MeasuredCells(const Decision& d) {
  const bool none = std::all_of(d.measured_dps.begin(), d.measured_dps.end(),
                                [](double dps) { return dps == 0; });
  std::string cells;
  for (const double dps : d.measured_dps) {
    cells += none ? "<td class=\"nil\">–</td>" : fmt::format("<td>{:.3f}</td>", dps);
  }
  return cells;
}

std::string RefusalRow(const History::Reading& reading, const History& history) {
  const Decision& d = reading.decision;
  const std::string_view quantity = QuantityOf(d.code);
  const std::string provoked =
      reading.expected()
          ? Escaped(StimulusText(history.stimuli[static_cast<std::size_t>(reading.stimulus)]))
          : "<strong>unexpected</strong>";
  return fmt::format(
      "<tr{}><td>{:.1f}</td><td>{:.2f}</td><td class=\"text\">{} {}</td><td>{}</td>{}"
      "<td>{}</td><td>{}</td><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>\n",
      reading.expected() ? "" : " class=\"unexpected\"", reading.t_s, d.temp_degc,
      static_cast<int>(d.code), Escaped(CodeName(d.code)),
      d.axis < 3 ? std::string(1, "xyz"[d.axis]) : "–", MeasuredCells(d),
      quantity.empty() ? "–" : fmt::format("{:.4g}", d.value),
      quantity.empty() ? "–" : fmt::format("{:.4g}", d.limit), quantity, provoked);
}

}  // namespace

std::string RefusalsHtml(const History& history) {
  std::vector<const History::Reading*> refusals;
  for (const History::Reading& reading : history.readings) {
    if (zro::IsRejection(reading.decision.code)) refusals.push_back(&reading);
  }
  if (refusals.empty()) return "<p>No reading was refused.</p>\n";
  const auto unexpected = std::count_if(refusals.begin(), refusals.end(),
                                        [](const auto* reading) { return !reading->expected(); });
  std::string out = fmt::format(
      "<p>{} refusals, {} of them unexpected: no stimulus acted then or "
      "in the 10 s before.",
      refusals.size(), unexpected);
  if (refusals.size() > kShownRefusals) {
    out += fmt::format(" The first {} are listed.", kShownRefusals);
    refusals.resize(kShownRefusals);
  }
  out +=
      "</p>\n<table class=\"refusals\"><thead><tr><th>t [s]</th><th>T [°C]</th>"
      "<th class=\"text\">code</th><th>axis</th><th>x [dps]</th><th>y [dps]</th><th>z [dps]</th>"
      "<th>value</th><th>limit</th><th class=\"text\">of</th><th class=\"text\">stimulus</th></tr>"
      "</thead><tbody>\n";
  for (const auto* reading : refusals) out += RefusalRow(*reading, history);
  return out + "</tbody></table>\n";
}

std::string DecisionsText(const History::Tone& tone) {
  std::vector<std::string> texts;
  for (const auto& [code, count] : tone.decisions) {
    texts.push_back(fmt::format("{} × {}\u00a0{}", count, static_cast<int>(code), CodeName(code)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string TonesHtml(const History& history) {
  if (history.tones.empty()) return "<p>No tone was played.</p>\n";
  std::string out =
      "<table><thead><tr><th>f [Hz]</th><th>SPL [dB re 20 µPa]</th><th>t [s]</th><th>T [°C]</th>"
      "<th>x [mdps]</th><th>y [mdps]</th><th>z [mdps]</th><th class=\"text\">readings</th></tr>"
      "</thead><tbody>\n";
  const auto number = [](double value, int digits) {
    return std::isnan(value) ? std::string("–") : fmt::format("{:.{}f}", value, digits);
  };
  for (const History::Tone& tone : history.tones) {
    const double half_hz = tone.band_hz / 2;
    const std::string hz = half_hz > 0
                               ? fmt::format("{:g}–{:g}", tone.hz - half_hz, tone.hz + half_hz)
                               : fmt::format("{:g}", tone.hz);
    out += fmt::format("<tr><td>{}</td><td>{:g}</td><td>{:.1f} .. {:.1f}</td><td>{}</td>", hz,
                       tone.spl_db, tone.from_s, tone.to_s, number(tone.board_degc, 2));
    for (const double dps : tone.shift_dps) out += fmt::format("<td>{}</td>", number(dps * 1e3, 1));
    out += fmt::format("<td class=\"text\">{}</td></tr>\n", Escaped(DecisionsText(tone)));
  }
  return out + "</tbody></table>\n";
}

}  // namespace zrobench
