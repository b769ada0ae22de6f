#include "rig/diagnose/diagnosis_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace zrobench::diagnose {
namespace {

using Buffer = std::back_insert_iterator<std::string>;

std::string Headline(const Diagnosis& d) {
  switch (d.outcome) {
    case Outcome::kNoMissingPhysics:
      return "nothing is missing: the model explains the recording down to its noise";
    case Outcome::kRecalibrate:
      return "no physics is missing, but nominal values in the station file are off";
    case Outcome::kNamed:
      return "the simulation leaves out what is named below";
    case Outcome::kAmbiguitySet:
      return "something is missing, and this recording cannot tell which of these it is";
    case Outcome::kPartlyExplained:
      return "part of the mismatch is named below; the rest is nothing in the catalogue";
    case Outcome::kUnexplained:
      return "simulation and recording differ, and nothing in the catalogue explains it";
    case Outcome::kBusFault:
      break;
  }
  return "the data are unfit for physics: " + d.reason;
}

/// Rates read in mdps.
void Error(Buffer out, const std::string& channel, double value) {
  const bool rate = channel.ends_with("_dps");
  fmt::format_to(out, " {:>9.3g} {:<4}", rate ? value * 1e3 : value, rate ? "mdps" : "K");
}

void Where(const Diagnosis& d, Buffer out) {
  if (!d.mismatch.detected) return;
  fmt::format_to(out, "\nwhere\n  channels  {}\n", fmt::join(d.mismatch.channels, ", "));
  for (const auto& [run, stretches] : d.mismatch.intervals_s) {
    double total_s = 0;
    for (const auto& [begin, end] : stretches) total_s += end - begin;
    constexpr std::size_t kShown = 4;
    fmt::format_to(out, "  {:<8}  {:.0f} s in {} stretches:", run, total_s, stretches.size());
    for (std::size_t i = 0; i < std::min(kShown, stretches.size()); ++i) {
      fmt::format_to(out, " {:.0f}..{:.0f}", stretches[i].first, stretches[i].second);
    }
    fmt::format_to(out, "{}\n", stretches.size() > kShown ? " ..." : "");
  }
}

void Terms(const Diagnosis& d, Buffer out) {
  for (const TermFound& term : d.terms) {
    fmt::format_to(out, "\n{}\n  {}\n  {}\n", term.info->id, term.info->sentence,
                   term.info->equation);
    for (const ParameterFound& p : term.parameters) {
      fmt::format_to(out, "    {:<24} {:>11.4g} {:<12}", p.name, p.value, p.unit);
      if (p.ci95) fmt::format_to(out, " 95 %: {:.4g} .. {:.4g}", p.ci95->first, p.ci95->second);
      fmt::format_to(out, "\n");
    }
    fmt::format_to(out, "  log likelihood +{:.1f}, p {:.2g}\n", term.log_likelihood_gain,
                   term.p_value);
  }
}

void ErrorsTable(const Diagnosis& d, Buffer out) {
  if (d.errors.before.empty()) return;
  const bool heldout = !d.errors.heldout_before.empty();
  fmt::format_to(out, "\nrms of measured - predicted{}\n  {:<12} {:>14} {:>14}",
                 heldout ? " (right: on runs that the fit had not seen)" : "", "", "before",
                 "after");
  if (heldout) fmt::format_to(out, " {:>14} {:>14}", "before", "after");
  fmt::format_to(out, "\n");
  for (const auto& [channel, before] : d.errors.before) {
    fmt::format_to(out, "  {:<12}", channel);
    Error(out, channel, before);
    Error(out, channel, d.errors.after.at(channel));
    if (heldout) {
      Error(out, channel, d.errors.heldout_before.at(channel));
      Error(out, channel, d.errors.heldout_after.at(channel));
    }
    fmt::format_to(out, "\n");
  }
}

void Rivals(const Diagnosis& d, Buffer out) {
  if (!d.ambiguity.empty()) {
    fmt::format_to(out, "\nexplanations that fit alike\n");
    for (const physics::TermInfo* info : d.ambiguity) {
      fmt::format_to(out, "  {:<40} {}\n", info->id, info->sentence);
    }
  }
  bool titled = false;
  for (const Rival& rival : d.rivals) {
    if (std::ranges::find(d.ambiguity, rival.info) != d.ambiguity.end()) continue;
    if (!titled) fmt::format_to(out, "\nlook-alikes rejected (evidence short of the best)\n");
    titled = true;
    fmt::format_to(out, "  {:<40} {:>8.1f}\n", rival.info->id, rival.evidence_short);
  }
}

void Limits(const Diagnosis& d, Buffer out) {
  if (!d.limits.empty()) {
    fmt::format_to(out, "\nwhat this recording would have shown (five sigma)\n");
    for (const Limit& limit : d.limits) {
      fmt::format_to(out, "  {:<40} {} >= {:.3g} {}\n", limit.info->id, limit.parameter,
                     limit.smallest_visible, limit.unit);
    }
  }
  if (!d.not_excited.empty()) {
    fmt::format_to(out, "\nnot excited: {}\n", fmt::join(d.not_excited, ", "));
  }
  if (!d.not_testable.empty()) {
    fmt::format_to(out, "\nnot testable with these columns: {}\n", fmt::join(d.not_testable, ", "));
  }
}

}  // namespace

std::string ToText(const Diagnosis& d, const std::string& name) {
  std::string text;
  const Buffer out = std::back_inserter(text);
  fmt::format_to(out, "{}: {}\n\n{}\n", name, OutcomeName(d.outcome), Headline(d));
  if (d.outcome == Outcome::kBusFault) return text;
  Where(d, out);
  Terms(d, out);
  if (!d.recalibrations.empty()) {
    fmt::format_to(out, "\nnominal values that the recording contradicts\n");
    for (const Recalibration& r : d.recalibrations) {
      fmt::format_to(out, "  {:<40} {:.4g} stated, {:.4g} +- {:.2g} fitted\n", r.key, r.nominal,
                     r.fitted, 2 * r.sd);
    }
  }
  ErrorsTable(d, out);
  Rivals(d, out);
  Limits(d, out);
  fmt::format_to(out, "\nevidence {:.1f}, threshold {:.1f}; {:.1f} s\n", d.evidence, d.threshold,
                 d.seconds);
  return text;
}

std::string CatalogueText() {
  std::string text;
  const Buffer out = std::back_inserter(text);
  for (const physics::TermInfo& info : physics::Catalogue()) {
    fmt::format_to(out, "{}\n  {}\n  {}\n", info.id, info.sentence, info.equation);
    for (const physics::ParameterInfo& p : info.parameters) {
      fmt::format_to(out, "    {} [{}], {} {:g}: {}\n", p.name, p.unit,
                     p.coefficient ? "typically" : "default",
                     p.coefficient ? p.typical : p.defaults.front(), p.sign);
    }
    fmt::format_to(out, "  shows in: {}; needs: {}{}\n", fmt::join(info.channels, ", "),
                   info.excitation, info.scanned ? "" : "; run forward only, not searched for");
    fmt::format_to(out, "  looks like: {}\n  source: {}\n\n", fmt::join(info.lookalikes, ", "),
                   info.source);
  }
  return text;
}

}  // namespace zrobench::diagnose
