#include "corrector/sanity.h"

#include "corrector/arithmetic.h"

namespace zro {
namespace {

constexpr float kSigmas = 3.0f;
// However old, uncertain or remote: a reading further off than this many steps is not believed.
constexpr float kMaxSteps = 3.0f;
// A single pair says nothing about the slope; steps allowed while that is all there is.
constexpr float kMaxStepsLone = 10.0f;
constexpr float kAgreeSigmas = 2.0f;
constexpr std::uint8_t kSettledWeight = 3;  // below it every reading is welcome
constexpr float kFineShare = 0.5f;
constexpr float kLeastMergeGain = 0.125f;

int ActiveEntries(const Table& table) {
  int count = 0;
  for (int i = 0; i < table.size(); ++i) count += table.IsActive(i) ? 1 : 0;
  return count;
}

/// Tolerance about an expectation: the step, the uncertainties of both sides and of the entry's
/// age, the shape unknown between entries; bounded.
float Tolerance(const Estimate& expected, const Summary& reading, float age_sigma, float max_step,
                float max_steps) {
  const float sigma =
      sqrtf(Square(expected.noise_dps) + Square(reading.sigma_dps) + Square(age_sigma));
  return Min(max_step + kSigmas * sigma + expected.model_dps, max_steps * max_step);
}

Finding Compare(Code code, const Estimate& expected, const Summary& reading, float tolerance) {
  const Worst worst = WorstDifference(reading.zro_dps, expected.zro_dps);
  return {code, worst.axis, worst.value, tolerance};
}

bool IsClose(const Finding& f) { return f.value <= f.limit; }

/// Fig. 5, 54: what becomes of a sane reading whose bin has an entry.
Code Update(const Entry& entry, const Summary& reading, const Age& age, float difference_dps,
            bool may_merge, bool lone) {
  if (age.IsOld(entry)) return Code::kOverwroteOld;
  if (!age.IsRecent(entry)) return Code::kMerged;
  const float sigma = sqrtf(Square(entry.sigma_dps) + Square(reading.sigma_dps));
  const bool tells_nothing =
      entry.weight >= kSettledWeight && difference_dps <= kAgreeSigmas * sigma;
  const bool coarse = entry.sigma_dps > kFineShare * reading.sigma_dps;
  return (may_merge && !tells_nothing) || (!may_merge && coarse && !lone)
             ? Code::kMerged
             : Code::kRecentNothingToDo;
}

}  // namespace

Decision CheckSanity(const Table& table, const Summary& reading, const Age& age,
                     const Limits& limits, bool may_merge) {
  Decision d{};
  d.entry = table.InBin(reading.temp_degc, Origin::kLearned);
  const int near = table.Nearest(reading.temp_degc);
  if (near < 0) {
    const Worst bias = WorstDifference(reading.zro_dps, d.expected_dps);
    d.finding = {Code::kNew, bias.axis, bias.value, limits.max_bias_dps};
    return d;
  }
  const Estimate expected = table.At(reading.temp_degc);
  for (int axis = 0; axis < kAxes; ++axis) d.expected_dps[axis] = expected.zro_dps[axis];
  d.expected_sigma_dps = expected.sigma_dps;
  const bool entry_is_close = expected.distance_degc <= table.bin_degc();
  const Code refusal = entry_is_close ? Code::kDiffersFromEntry : Code::kDiffersFromEstimate;
  const bool lone = ActiveEntries(table) == 1;
  const float max_steps = lone ? kMaxStepsLone : kMaxSteps;
  d.finding = Compare(
      refusal, expected, reading,
      Tolerance(expected, reading, age.SigmaOf(table[near]), limits.max_step_dps, max_steps));
  if (IsClose(d.finding)) {  // 59, by way of 54 when the bin has an entry
    d.finding.code = d.entry < 0
                         ? Code::kNew
                         : Update(table[d.entry], reading, age, d.finding.value, may_merge, lone);
    return d;
  }
  if (!entry_is_close) return d;  // 58
  // 56: reading and close entry differ, so the others are asked. They are a witness only where
  // they know better than the step that is in question.
  const Estimate others = table.At(reading.temp_degc, near);
  if (!others.valid || others.model_dps > 0.5f * limits.max_step_dps) return d;
  const float tight =
      limits.max_step_dps + kSigmas * sqrtf(Square(others.noise_dps) + Square(reading.sigma_dps));
  Finding by_others =
      Compare(Code::kOverwroteOld, others, reading, Min(tight, kMaxSteps * limits.max_step_dps));
  if (!IsClose(by_others) || by_others.value >= d.finding.value) return d;
  if (d.entry < 0) by_others.code = Code::kNew;
  d.finding = by_others;
  return d;
}

Entry Merge(const Entry& entry, const Summary& reading, const Age& age, bool corroborates) {
  const float old_variance = Square(entry.sigma_dps) + Square(age.SigmaOf(entry));
  const float new_variance = Square(reading.sigma_dps);
  const float gain = Max(old_variance / (old_variance + new_variance), kLeastMergeGain);
  Entry merged = entry;
  merged.temp_degc += gain * (reading.temp_degc - entry.temp_degc);
  for (int axis = 0; axis < kAxes; ++axis) {
    merged.zro_dps[axis] += gain * (reading.zro_dps[axis] - entry.zro_dps[axis]);
  }
  merged.sigma_dps = sqrtf(Square(1.0f - gain) * old_variance + Square(gain) * new_variance);
  if (corroborates && merged.weight < 255) ++merged.weight;
  return merged;
}

}  // namespace zro
