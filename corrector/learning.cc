// The loop of figure 4: still (34, 36), read (38, 40), check (42), write (44), repeat (46) or STOP.
#include "corrector/corrector.h"

namespace zro {
namespace {

constexpr float kSettleS = 0.5f;        // quiet before a window opens: the device rocks to rest
constexpr float kBackOffS = 20.0f;      // after the re-reads are used up; grows to three times
constexpr float kWatchS = 60.0f;        // between readings while the table is complete
constexpr float kMergeAgainS = 600.0f;  // one still may not corroborate itself faster
constexpr float kSayAgainS = 60.0f;     // kRecentNothingToDo of the same bin and still
constexpr float kCommitSoonS = 0.5f;    // new knowledge; gathers the writes of one moment
constexpr float kCleanRatio = 1.15f;    // noise over its floor, of evidence: 5 sigma of 500 samples
constexpr float kCommitMergesS = 3600.0f;
constexpr std::uint8_t kConfirmedWeight = 3;  // readings after which a lone entry is trusted

}  // namespace

void Corrector::Learn(const Sample& sample) {
  const bool ended = stillness_.Step(sample, config_.limits.still_sigma_g);
  if (stillness_.quiet_samples() <= 1) noise_ = PresentNoise(config_.sample_hz);
  if (IsUsable(sample)) noise_.Add(sample.rate_dps);
  if (config_.limits.mode != Mode::kLearnApply) {
    reading_.Stop();
    period_ = {};
    return;
  }
  if (ended) EndStill();
  if (period_.waiting && Due(period_.resume_at)) period_.waiting = false;
  if (period_.waiting || stillness_.quiet_samples() < Samples(kSettleS)) {
    reading_.Stop();
    return;
  }
  if (!reading_.gathering()) {
    reading_.Restart(config_.limits.min_samples);
    tested_ = false;
  }
  tested_ = tested_ || test_mode_;
  reading_.Add(sample, temp_degc_, temp_valid_);
  if (reading_.ripe() && stillness_.still()) Judge();
}

void Corrector::EndStill() {
  const Stillness::Interruption& why = stillness_.interruption();
  Finding reason{why.code, why.axis, why.value, why.limit};
  const float* measured = nullptr;
  float temp = temp_degc_;
  if (period_.pending.code != Code::kNone) {
    reason = period_.pending;
    measured = candidate_.zro_dps;
    temp = candidate_.temp_degc;
  } else if (!period_.judged && why.code == Code::kMotion) {
    reason = {Code::kTooShort, kNoAxis, static_cast<float>(reading_.gathered()) / config_.sample_hz,
              static_cast<float>(config_.limits.min_samples) / config_.sample_hz};
  }
  const bool contradicted = period_.pending.code != Code::kNone;
  if (!complete_ || contradicted) Emit(reason, temp, measured);
  if (contradicted) Vote();
  period_ = {};
  reading_.Stop();
}

void Corrector::Judge() {
  const Summary reading = reading_.Summarise();
  reading_.Stop();
  period_.judged = true;
  if (tested_) {
    Refuse({Code::kTestMode, kNoAxis, 1.0f, 0.0f}, reading);
    return;
  }
  const Finding quality = AssessQuality(reading, config_.limits, floor_);
  if (quality.code != Code::kNone) {
    Refuse(quality, reading);
    return;
  }
  const Decision decision =
      CheckSanity(table_, reading, Ages(), config_.limits, MayMerge(reading.temp_degc));
  if (IsRejection(decision.finding.code)) {
    Contradict(decision, reading);
  } else {
    Accept(decision, reading);
  }
}

void Corrector::Refuse(const Finding& finding, const Summary& reading) {
  Emit(finding, reading.temp_degc, reading.zro_dps);
  period_.pending = {};
  if (period_.refusals < 255) ++period_.refusals;
  if (period_.refusals <= config_.max_retries) return;
  const int times = period_.refusals - config_.max_retries;
  period_.waiting = true;
  period_.resume_at = sample_ + Samples(kBackOffS * static_cast<float>(times < 3 ? times : 3));
}

Quarantine::Vote Corrector::VoteOf(const Decision& decision, const Summary& reading) const {
  const bool lone = table_.size() == 1 && table_[0].origin == Origin::kLearned &&
                    table_[0].weight < kConfirmedWeight;
  const float sigma = sqrtf(Square(reading.sigma_dps) + Square(decision.expected_sigma_dps));
  Quarantine::Vote vote{{}, sigma, config_.limits.max_step_dps, sample_, lone, floor_.learned()};
  for (int axis = 0; axis < kAxes; ++axis) {
    vote.shift_dps[axis] = reading.zro_dps[axis] - decision.expected_dps[axis];
  }
  return vote;
}

bool Corrector::IsClean(const Summary& reading) const {
  for (int axis = 0; axis < kAxes; ++axis) {
    if (floor_.Ratio(reading.std_dps[axis], axis) > kCleanRatio) return false;
  }
  return true;
}

void Corrector::Contradict(const Decision& decision, const Summary& reading) {
  candidate_ = EntryOf(reading);
  candidate_vote_ = VoteOf(decision, reading);
  period_.clean = IsClean(reading);
  if (period_.clean && quarantine_.Agrees(candidate_vote_)) {
    Follow(decision, reading);
    return;
  }
  if (period_.refusals < config_.max_retries) {
    Finding retry = decision.finding;
    retry.code = Code::kRetry;
    Emit(retry, reading.temp_degc, reading.zro_dps);
    period_.pending = decision.finding;
    ++period_.refusals;
    return;
  }
  Refuse(decision.finding, reading);
  Vote();
}

void Corrector::Follow(const Decision& decision, const Summary& reading) {
  if (!period_.voted) {
    Emit(decision.finding, reading.temp_degc, reading.zro_dps);
    period_.pending = {};
    Vote();
  }
  if (!quarantine_.follows()) return;
  Estimate prior = table_.At(reading.temp_degc);
  float table[kAxes];
  for (int axis = 0; axis < kAxes; ++axis) {
    table[axis] = decision.expected_dps[axis] + quarantine_.shift_dps()[axis];
  }
  AddPresent(reading.temp_degc, &prior);
  residual_.Take(reading, prior, table, sample_);
}

void Corrector::Vote() {
  if (period_.voted || !period_.clean) return;
  period_.voted = true;
  const bool lone = candidate_vote_.lone;
  const Quarantine::Verdict verdict = quarantine_.Add(candidate_vote_);
  const auto votes = static_cast<float>(quarantine_.votes());
  const auto needed = static_cast<float>(lone ? Quarantine::kVotesLone : Quarantine::kVotes);
  if (verdict == Quarantine::Verdict::kReplaced) {
    Emit({Code::kQuarantineExpired, kNoAxis, votes, needed}, candidate_.temp_degc,
         candidate_.zro_dps);
  }
  if (verdict == Quarantine::Verdict::kConfirmed) {
    Confirm();
  } else {
    Emit({Code::kQuarantined, kNoAxis, votes, needed}, candidate_.temp_degc, candidate_.zro_dps);
  }
}

void Corrector::Confirm() {
  constexpr float kZero[kAxes] = {};
  const Worst shift = WorstDifference(quarantine_.shift_dps(), kZero);
  ShiftTable(quarantine_.shift_dps());
  table_.Insert(candidate_);
  Emit({Code::kShiftConfirmed, shift.axis, shift.value, config_.limits.max_step_dps},
       candidate_.temp_degc, candidate_.zro_dps);
  quarantine_.Clear();
  residual_.Clear();
  NoteWrite(candidate_.temp_degc, true);
  UpdateCompletion();
}

void Corrector::ShiftTable(const float shift_dps[kAxes]) {
  const float doubt =
      0.5f * config_.limits.max_step_dps;         // the shift need not be the same all over
  for (int i = table_.size() - 1; i >= 0; --i) {  // downwards: what is inserted comes behind
    if (!table_.IsActive(i)) continue;
    Entry entry = table_[i];
    for (int axis = 0; axis < kAxes; ++axis) entry.zro_dps[axis] += shift_dps[axis];
    entry.sigma_dps = sqrtf(Square(entry.sigma_dps) + Square(doubt));
    entry.date = 0;  // old as soon as the date is known: the next close reading overwrites it
    entry.weight = 1;
    if (entry.origin == Origin::kLearned) {
      table_.Replace(i, entry);
    } else {
      entry.origin = Origin::kLearned;  // shadows the factory's entry, which stays as it was
      table_.Insert(entry);
    }
  }
}

void Corrector::Accept(const Decision& decision, const Summary& reading) {
  floor_.Learn(reading);
  period_.refusals = 0;
  period_.pending = {};
  if (quarantine_.votes() > 0) {
    const auto votes = static_cast<float>(quarantine_.votes());
    quarantine_.Clear();
    Emit({Code::kQuarantineExpired, kNoAxis, votes, static_cast<float>(Quarantine::kVotes)},
         reading.temp_degc, reading.zro_dps);
  }
  Estimate prior = table_.At(reading.temp_degc);
  AddPresent(reading.temp_degc, &prior);
  const bool unknown = decision.finding.code == Code::kNew;  // a temperature beyond the coverage
  if (complete_ && !unknown) {  // STOP: the reading only showed that the table still holds
    period_.waiting = true;
    period_.resume_at = sample_ + Samples(kWatchS);
  } else if (decision.finding.code == Code::kRecentNothingToDo) {
    SayNothingToDo(decision.finding, reading);
  } else {
    Write(decision, reading);
  }
  residual_.Take(reading, prior, table_.At(reading.temp_degc).zro_dps, sample_);
}

void Corrector::Write(const Decision& decision, const Summary& reading) {
  Entry entry = EntryOf(reading);
  const bool merges = decision.finding.code == Code::kMerged;
  if (merges) {
    entry = Merge(table_[decision.entry], reading, Ages(), MayMerge(reading.temp_degc));
    if (date_ != 0) entry.date = date_;
  }
  if (decision.entry >= 0) {
    table_.Replace(decision.entry, entry);
  } else if (!table_.Insert(entry)) {
    return;
  }
  Emit(decision.finding, reading.temp_degc, reading.zro_dps);
  NoteWrite(reading.temp_degc, !merges);
  UpdateCompletion();
}

void Corrector::SayNothingToDo(const Finding& finding, const Summary& reading) {
  const auto bin = static_cast<std::int16_t>(table_.BinOf(reading.temp_degc));
  const bool repeats = period_.said && period_.said_bin == bin;
  if (repeats && sample_ - period_.said_at < Samples(kSayAgainS)) return;
  period_.said = true;
  period_.said_bin = bin;
  period_.said_at = sample_;
  Emit(finding, reading.temp_degc, reading.zro_dps);
}

void Corrector::NoteWrite(float temp_degc, bool promptly) {
  updated_ = true;
  dirty_ = true;
  fresh_ = false;
  period_.wrote = true;
  period_.written_bin = static_cast<std::int16_t>(table_.BinOf(temp_degc));
  period_.written_at = sample_;
  if (store_failing_) return;  // tried again when it is time, not before
  if (promptly) {
    commit_at_ = sample_ + Samples(kCommitSoonS);
  } else if (!commit_due_) {
    const std::uint32_t since = sample_ - last_commit_;
    const std::uint32_t hour = Samples(kCommitMergesS);
    commit_at_ = sample_ + (since < hour ? hour - since : 0);
  }
  commit_due_ = true;
}

bool Corrector::MayMerge(float temp_degc) const {
  return !period_.wrote || period_.written_bin != table_.BinOf(temp_degc) ||
         sample_ - period_.written_at >= Samples(kMergeAgainS);
}

Entry Corrector::EntryOf(const Summary& reading) const {
  Entry entry{reading.temp_degc, {}, reading.sigma_dps, date_, 1, Origin::kLearned};
  for (int axis = 0; axis < kAxes; ++axis) entry.zro_dps[axis] = reading.zro_dps[axis];
  return entry;
}

bool Corrector::EveryBinIsFresh() const {
  const Age age = Ages();
  const float half = 0.5f * config_.bin_degc;
  const int last = table_.BinOf(config_.coverage_max_degc - half);
  for (int bin = table_.BinOf(config_.coverage_min_degc + half); bin <= last; ++bin) {
    const float centre = Table::kFirstBinDegc + (static_cast<float>(bin) + 0.5f) * config_.bin_degc;
    const int entry = table_.InBin(centre, Origin::kLearned);
    if (entry < 0 || age.IsOld(table_[entry])) return false;
  }
  return true;
}

void Corrector::UpdateCompletion() {
  const bool now = EveryBinIsFresh();
  if (now == complete_) return;
  complete_ = now;
  Emit({now ? Code::kTableComplete : Code::kReArmed, kNoAxis, 0.0f,
        static_cast<float>(config_.old_days)},
       temp_degc_, nullptr);
}

}  // namespace zro
