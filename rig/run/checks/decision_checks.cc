// rejects, decides, no_unexpected_rejection, no_corrupt_entry, table_complete: what the board
// decided while the rig provoked it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/units.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"
#include "rig/run/reference.h"

namespace zrobench {
namespace {

constexpr std::uint64_t kSecond_us = 1'000'000;
/// A refusal may come up to a reading (and its re-reads) after the stimulus: it judges what it
/// averaged.
constexpr std::uint64_t kVerdictDelay_us = 8 * kSecond_us;
constexpr std::uint64_t kReading_us = 5 * kSecond_us;  ///< averaging window of one reading
constexpr std::uint64_t kGraze_us = kSecond_us / 2;    ///< overlap too short to matter

std::vector<int> Codes(const Expectation& expect) {
  std::vector<int> codes;
  for (const auto& [key, value] : expect.arguments) {
    if (key == "code") codes.push_back(static_cast<int>(std::get<double>(value)));
    if (key != "codes") continue;
    for (const double code : std::get<std::vector<double>>(value)) {
      codes.push_back(static_cast<int>(code));
    }
  }
  return codes;
}

std::string Text(const Expectation& expect, const std::string& wanted) {
  for (const auto& [key, value] : expect.arguments) {
    if (key == wanted) return std::get<std::string>(value);
  }
  return {};
}

/// Where refusals are looked for: in and just after every stimulus of that kind, or anywhere.
std::vector<Interval> Windows(const Evidence& evidence, const std::string& during) {
  if (during.empty()) return {{evidence.first_us, evidence.last_us, "the run"}};
  std::vector<Interval> windows;
  for (const Interval& stimulus : evidence.stimuli) {
    if (!stimulus.Is(during)) continue;
    windows.push_back({stimulus.first_us, stimulus.last_us + kVerdictDelay_us, stimulus.kind});
  }
  return windows;
}

std::string LostDecisions(const Evidence& evidence) {
  return fmt::format("{} decisions of the board were lost", evidence.decisions_lost);
}

}  // namespace

CheckResult CheckRejects(const Expectation& expect, const CheckContext& context) {
  const std::vector<int> codes = Codes(expect);
  const std::string during = Text(expect, "during");
  CheckResult result = StartCheck(
      expect,
      fmt::format("refused with {} during {}",
                  codes.empty() ? "any code" : fmt::format("code {}", fmt::join(codes, " or ")),
                  during.empty() ? "the run" : during));
  const auto wanted = [&](const TimedDecision& d) {
    if (codes.empty()) return zro::IsRejection(d.record.code);
    return std::find(codes.begin(), codes.end(), static_cast<int>(d.record.code)) != codes.end();
  };
  const auto& decisions = context.evidence.decisions;
  for (const Interval& window : Windows(context.evidence, during)) {
    const auto count = std::count_if(decisions.begin(), decisions.end(), [&](const auto& d) {
      return wanted(d) && d.at_us >= window.first_us && d.at_us <= window.last_us;
    });
    result.measurements.push_back({.name = "rejects." + window.kind,
                                   .value = static_cast<double>(count),
                                   .unit = "1",
                                   .low = expect.number("at_least", 1),
                                   .first_us = window.first_us,
                                   .last_us = window.last_us});
  }
  if (result.measurements.empty()) result.reason = "no " + during + " was played";
  JudgeCheck(result);
  if (result.verdict == Verdict::kFail && context.evidence.decisions_lost > 0) {
    // The refusal may be among those that we did not get to see.
    result.verdict = Verdict::kInconclusive;
    result.reason = LostDecisions(context.evidence);
  }
  return result;
}

namespace {

/// Readings that were written although a stimulus acted while they were averaged.
Measurement WritesDuringStimuli(const Evidence& evidence) {
  Measurement m{.name = "no_corrupt_entry.during_stimulus",
                .unit = "1",
                .high = 0,
                .first_us = evidence.first_us,
                .last_us = evidence.last_us};
  for (const TimedDecision& decision : evidence.decisions) {
    if (!zro::IsWrite(decision.record.code)) continue;
    const std::uint64_t from = decision.at_us - std::min(decision.at_us, kReading_us);
    const bool corrupt =
        std::any_of(evidence.stimuli.begin(), evidence.stimuli.end(), [&](const Interval& i) {
          // Most tones of a sweep do nothing: what it spoiled is seen by its error alone.
          return i.kind != "off" && !i.Is("sweep") &&
                 i.Overlaps(from + kGraze_us, std::max(decision.at_us, kGraze_us) - kGraze_us);
        });
    m.value += corrupt ? 1 : 0;
  }
  return m;
}

}  // namespace

CheckResult CheckNoCorruptEntry(const Expectation& expect, const CheckContext& context) {
  const double within = expect.number("within_mdps", 50);
  CheckResult result = StartCheck(
      expect, fmt::format("no reading taken during a stimulus was stored, none off by more than "
                          "{:g} mdps",
                          within));
  result.measurements.push_back(WritesDuringStimuli(context.evidence));
  for (const TimedDecision& decision : context.evidence.decisions) {
    if (!zro::IsWrite(decision.record.code)) continue;
    const auto reference =
        ReferenceAt(SameAge(context.evidence, decision.at_us), decision.record.temp_degc);
    if (!reference) continue;
    Measurement m{.name = fmt::format("no_corrupt_entry.{:.1f}", decision.record.temp_degc),
                  .unit = "mdps",
                  .high = within,
                  .first_us = decision.at_us - std::min(decision.at_us, kReading_us),
                  .last_us = decision.at_us};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double error = std::abs(decision.record.measured_dps[axis] - reference->zro_dps[axis]);
      if (MdpsFromDps(error) < m.value) continue;
      m.value = MdpsFromDps(error);
      m.uncertainty_k2 = MdpsFromDps(reference->uncertainty_k2_dps[axis]);
    }
    result.measurements.push_back(m);
  }
  JudgeCheck(result);
  if (result.verdict == Verdict::kFail) return result;
  const bool tempted = result.measurements.size() > 1 || !context.evidence.stimuli.empty();
  if (context.evidence.decisions_lost > 0 || !tempted) {
    result.verdict = Verdict::kInconclusive;
    result.reason = tempted ? LostDecisions(context.evidence)
                            : "nothing was written and no stimulus was there to tempt it";
  }
  return result;
}

CheckResult CheckNoUnexpectedRejection(const Expectation& expect, const CheckContext& context) {
  const double at_most = expect.number("at_most", 0);
  const Evidence& evidence = context.evidence;
  CheckResult result =
      StartCheck(expect, fmt::format("at most {:g} refusals where no stimulus acted", at_most));
  Measurement m{.name = "no_unexpected_rejection",
                .unit = "1",
                .high = at_most,
                .first_us = evidence.first_us,
                .last_us = evidence.last_us};
  for (const TimedDecision& decision : evidence.decisions) {
    if (!zro::IsRejection(decision.record.code)) continue;
    const bool provoked =
        std::any_of(evidence.stimuli.begin(), evidence.stimuli.end(), [&](const Interval& i) {
          return decision.at_us >= i.first_us && decision.at_us <= i.last_us + kVerdictDelay_us;
        });
    m.value += provoked ? 0 : 1;
  }
  result.measurements.push_back(m);
  JudgeCheck(result);
  if (result.verdict != Verdict::kFail && evidence.decisions_lost > 0) {
    result.verdict = Verdict::kInconclusive;
    result.reason = LostDecisions(evidence);
  }
  return result;
}

CheckResult CheckDecides(const Expectation& expect, const CheckContext& context) {
  const std::vector<int> codes = Codes(expect);
  const Evidence& evidence = context.evidence;
  CheckResult result =
      StartCheck(expect, fmt::format("decisions with code {}", fmt::join(codes, " or ")));
  Measurement m{.name = "decides",
                .unit = "1",
                .low = expect.number("at_least", 0),
                .high = expect.number("at_most", HUGE_VAL),
                .first_us = evidence.first_us,
                .last_us = evidence.last_us};
  for (const TimedDecision& decision : evidence.decisions) {
    const int code = static_cast<int>(decision.record.code);
    m.value += std::find(codes.begin(), codes.end(), code) != codes.end() ? 1 : 0;
  }
  result.measurements.push_back(m);
  JudgeCheck(result);
  // Lost decisions can only add: too many stay too many, all else is open.
  if (evidence.decisions_lost > 0 && m.value <= m.high) {
    result.verdict = Verdict::kInconclusive;
    result.reason = LostDecisions(evidence);
  }
  return result;
}

CheckResult CheckTableComplete(const Expectation& expect, const CheckContext& context) {
  const Evidence& evidence = context.evidence;
  CheckResult result = StartCheck(
      expect, "the board calls its table complete (code 40), and not later otherwise (41)");
  Measurement m{.name = "table_complete",
                .unit = "1",
                .low = 1,
                .first_us = evidence.first_us,
                .last_us = evidence.last_us};
  for (const TimedDecision& decision : evidence.decisions) {
    if (decision.record.code == zro::Code::kTableComplete) m.value = 1;
    if (decision.record.code == zro::Code::kReArmed) m.value = 0;
  }
  result.measurements.push_back(m);
  JudgeCheck(result);
  if (evidence.decisions_lost > 0) {
    result.verdict = Verdict::kInconclusive;
    result.reason = LostDecisions(evidence);
  }
  return result;
}

}  // namespace zrobench
