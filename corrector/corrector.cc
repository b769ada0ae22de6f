// The corrector's outer face: samples in, corrected rates and events out, the store.
// What is learned, and when: learning.cc.
#include "corrector/corrector.h"

namespace zro {
namespace {

constexpr float kRetryCommitS = 60.0f;  // a failing memory is not hammered
constexpr float kLineDegc = 0.125f;     // the curve is straight this far

}  // namespace

Corrector::Corrector(const Config& config, Storage* storage)
    : config_(config),
      table_(config.bin_degc),
      store_(storage),
      stillness_(config.sample_hz),
      reading_(config.sample_hz),
      floor_(config.gyro_noise_density_dps_per_rthz, config.sample_hz),
      noise_(config.sample_hz),
      quarantine_(config.sample_hz),
      residual_(config.sample_hz),
      thermometer_(config.sample_hz) {}

void Corrector::Boot() {
  store_invalid_ = store_.Read(&table_, &generation_) == Store::Load::kInvalid;
  fresh_ = false;
  if (store_invalid_) Emit({Code::kStoreInvalid, kNoAxis, 0.0f, 0.0f}, 0.0f, nullptr);
  UpdateCompletion();
}

void Corrector::SetDate(std::uint16_t days) {
  date_ = days;
  UpdateCompletion();
}

Output Corrector::Step(const Sample& sample) {
  if (started_) sample_ += sample.elapsed;
  started_ = true;
  updated_ = false;
  TakeTemperature(sample);
  residual_.Expire(sample_);
  Learn(sample);
  if (quarantine_.Expire(sample_)) {
    Emit({Code::kQuarantineExpired, kNoAxis, Quarantine::kExpireS, Quarantine::kExpireS},
         temp_degc_, nullptr);
  }
  CommitIfDue();
  return Correct(sample);
}

bool Corrector::AddFactoryEntry(float temp_degc, const float zro_dps[kAxes], float sigma_dps) {
  Entry entry{temp_degc, {}, sigma_dps, 0, 1, Origin::kFactory};
  for (int axis = 0; axis < kAxes; ++axis) entry.zro_dps[axis] = zro_dps[axis];
  if (!table_.Insert(entry)) return false;
  dirty_ = true;
  fresh_ = false;
  residual_.Clear();   // it was the difference from another table
  UpdateCompletion();  // a full table gave up a learned entry
  return true;
}

bool Corrector::Commit() {
  if (!dirty_) return true;
  if (!store_.Write(table_, generation_ + 1)) {
    Emit({Code::kStoreWrite, kNoAxis, 0.0f, 0.0f}, temp_degc_, nullptr);
    store_failing_ = true;
    commit_due_ = true;
    commit_at_ = sample_ + Samples(kRetryCommitS);
    return false;
  }
  ++generation_;
  dirty_ = false;
  commit_due_ = false;
  store_invalid_ = false;
  store_failing_ = false;
  last_commit_ = sample_;
  return true;
}

bool Corrector::RestoreFactory() {
  for (int i = table_.size() - 1; i >= 0; --i) {
    if (table_[i].origin != Origin::kLearned) continue;
    table_.Remove(i);
    dirty_ = true;
  }
  dirty_ = dirty_ || store_invalid_;
  fresh_ = false;
  quarantine_.Clear();
  residual_.Clear();
  period_ = {};
  reading_.Stop();
  UpdateCompletion();
  return Commit();
}

void Corrector::TakeTemperature(const Sample& sample) {
  temp_valid_ = IsPhysicalTemperature(sample.temp_degc);
  if (!temp_valid_) return;  // the last good one is the best guess
  temp_degc_ = thermometer_.Take(sample.temp_degc, sample_);
  has_temp_ = true;
}

void Corrector::CommitIfDue() {
  if (commit_due_ && Due(commit_at_)) Commit();
}

Estimate Corrector::EstimateNow() {
  // A look-up costs as much as ten samples; temperatures move slowly. Between two it is a line.
  if (!fresh_ || fabsf(temp_degc_ - estimate_degc_) > kLineDegc) {
    estimate_ = table_.At(temp_degc_);
    const Estimate beyond = table_.At(temp_degc_ + kLineDegc);
    for (int axis = 0; axis < kAxes; ++axis) {
      slope_dps_per_degc_[axis] = (beyond.zro_dps[axis] - estimate_.zro_dps[axis]) / kLineDegc;
    }
    nearest_ = static_cast<std::int8_t>(table_.Nearest(temp_degc_));
    estimate_degc_ = temp_degc_;
    fresh_ = true;
  }
  Estimate now = estimate_;
  for (int axis = 0; axis < kAxes; ++axis) {
    now.zro_dps[axis] += slope_dps_per_degc_[axis] * (temp_degc_ - estimate_degc_);
  }
  return now;
}

Source Corrector::SourceOf(const Estimate& estimate) const {
  if (config_.limits.mode == Mode::kOff) return Source::kOff;
  if (!estimate.valid || !has_temp_) {
    return store_invalid_ ? Source::kInvalidLut : Source::kDefaultZero;
  }
  if (config_.limits.mode == Mode::kFrozen) return Source::kFrozen;
  if (estimate.extrapolated) return Source::kExtrapolatedHold;
  return reading_.gathering() && stillness_.still() && !complete_ ? Source::kLearning
                                                                  : Source::kInterpolated;
}

bool Corrector::Vibrates() const {
  if (!stillness_.still()) return false;
  for (int axis = 0; axis < kAxes; ++axis) {
    if (floor_.IsExceeded(noise_.Variance(axis), config_.limits.max_vibration_ratio, axis)) {
      return true;
    }
  }
  return false;
}

void Corrector::AddPresent(float temp_degc, Estimate* estimate) const {
  residual_.AddTo(estimate->zro_dps, temp_degc, sample_);
  if (!quarantine_.follows()) return;
  for (int axis = 0; axis < kAxes; ++axis) {
    estimate->zro_dps[axis] += quarantine_.shift_dps()[axis];
  }
  const float doubt = 0.5f * config_.limits.max_step_dps;  // it need not be the same all over
  estimate->sigma_dps = sqrtf(Square(estimate->sigma_dps) + Square(doubt));
}

Output Corrector::Correct(const Sample& sample) {
  Estimate estimate = EstimateNow();
  AddPresent(temp_degc_, &estimate);
  Output out{};
  out.source = SourceOf(estimate);
  const bool applies = out.source != Source::kOff && estimate.valid && has_temp_;
  for (int axis = 0; axis < kAxes; ++axis) {
    out.zro_dps[axis] = applies ? estimate.zro_dps[axis] : 0.0f;
    out.rate_dps[axis] = sample.rate_dps[axis] - out.zro_dps[axis];
  }
  // Without a table the offset may be anything a gyro's datasheet allows.
  out.sigma_dps = applies ? estimate.sigma_dps : config_.limits.max_bias_dps / 3.0f;
  const int nearest = has_temp_ ? nearest_ : -1;
  out.bin = nearest < 0 ? kNoBin : WireBin(table_[nearest].temp_degc);
  out.age_days = nearest < 0 ? Age::kUnknown : Ages().Of(table_[nearest]);
  out.still = stillness_.still();
  out.learning = out.still && reading_.gathering() && !complete_;
  out.vibration = Vibrates();
  out.updated = updated_;
  return out;
}

void Corrector::Emit(const Finding& finding, float temp_degc, const float* measured_dps) {
  Event event{};
  event.sample = sample_;
  event.code = finding.code;
  event.axis = finding.axis;
  event.bin = has_temp_ ? WireBin(temp_degc) : kNoBin;
  event.temp_degc = temp_degc;
  if (measured_dps != nullptr) {
    for (int axis = 0; axis < kAxes; ++axis) event.measured_dps[axis] = measured_dps[axis];
  }
  event.limit = finding.limit;
  event.value = finding.value;
  events_.Push(event);
}

std::uint8_t Corrector::WireBin(float temp_degc) const {
  const int bin = table_.BinOf(temp_degc);
  return bin < 0 || bin >= kNoBin ? kNoBin : static_cast<std::uint8_t>(bin);
}

}  // namespace zro
