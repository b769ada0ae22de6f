#include "rig/run/bus_tap.h"

#include <fmt/format.h>

#include <algorithm>

#include "corrector/node/codec.h"
#include "rig/run/evidence.h"

namespace zrobench {
namespace {

using namespace zro::node;  // the wire's messages

constexpr std::uint64_t kSecond_us = 1'000'000;

double GyroLsb_dps(std::uint8_t raw_flags) {
  return 125.0 * static_cast<double>(1 << (raw_flags & 0x0F)) / 32768;
}

}  // namespace

void BusTap::OnFrame(const CanFrame& frame) {
  const auto at_us = static_cast<std::uint64_t>(frame.at.time_since_epoch().count() / 1000);
  if (!frame.own && TakePart(frame, at_us)) return;
  TakeOther(frame, at_us);
}

bool BusTap::TakePart(const CanFrame& frame, std::uint64_t at_us) {
  const std::uint8_t flags = frame.frame.data[7];
  if (RawMsg raw; Decode(frame.frame, &raw)) {
    StartSample(at_us, raw.seq);
    std::copy_n(raw.raw, 3, sample_.raw.begin());
    sample_.raw_flags = flags;
    parts_ = kRaw;
  } else if (AccMsg acc; Decode(frame.frame, &acc)) {
    if (!(parts_ & kRaw) || acc.seq != sample_.seq) return false;
    std::copy_n(acc.acc, 3, sample_.accel.begin());
    sample_.accel_flags = flags;
    parts_ |= kAcc;
  } else if (RateMsg rate; Decode(frame.frame, &rate)) {
    if (!(parts_ & kRaw) || rate.seq != sample_.seq) return false;
    std::copy_n(rate.rate, 3, sample_.rate.begin());
    sample_.rate_flags = flags;
    parts_ |= kRate;
  } else {
    return false;
  }
  if (parts_ == kAll) FinishSample();
  return true;
}

void BusTap::StartSample(std::uint64_t at_us, std::uint8_t seq) {
  if (parts_ != 0) FinishSample();  // the one before never got all its parts
  TellIncomplete(at_us);
  sample_ = {};
  sample_.at_us = at_us;
  sample_.seq = seq;
}

void BusTap::FinishSample() {
  const bool complete = parts_ == kAll;
  parts_ = 0;
  log_.WriteSample(sample_);
  incomplete_ += complete ? 0 : 1;
  if (complete) AddToMean(sample_);
  WriteHeld();
}

void BusTap::TellIncomplete(std::uint64_t at_us) {
  if (incomplete_ == incomplete_told_ || at_us < next_alarm_us_) return;
  log_.Alarm(fmt::format("{}{} samples came without their DUT_ACC or DUT_RATE", kInputsLost,
                         incomplete_ - incomplete_told_));
  incomplete_told_ = incomplete_;
  next_alarm_us_ = at_us + kSecond_us;
}

void BusTap::Finish() {
  parts_ = 0;
  WriteHeld();
  TellIncomplete(next_alarm_us_);
}

void BusTap::WriteHeld() {
  for (const BusFrame& frame : held_) log_.Write(frame);
  held_.clear();
}

void BusTap::TakeOther(const CanFrame& frame, std::uint64_t at_us) {
  if (TimeMsg time; Decode(frame.frame, &time)) {
    imu_degc_ = time.temperature / 256.0;
    WatchBoardClock(time.sample_time_us);
    log_.Write(ImuTime{at_us, time.sample_time_us, time.sample_seq, time.temperature});
    return;
  }
  if (CorrMsg corr; Decode(frame.frame, &corr)) {
    ImuCorrection item{at_us, {}, corr.bin, corr.state, corr.age_s};
    std::copy_n(corr.corr, 3, item.zro.begin());
    log_.Write(item);
    return;
  }
  if (HeartbeatMsg beat; Decode(frame.frame, &beat) && beat.id == HeartbeatMsg::kNodeId &&
                         beat.state == kStateBootUp) {
    parts_ = 0;  // the life before ended within a sample: nobody will ever see the rest of it
    device_us_.reset();
    WriteHeld();
  }
  BusFrame item{at_us, frame.frame.id, frame.frame.dlc, frame.own, {}};
  std::copy_n(frame.frame.data, 8, item.data.begin());
  if (parts_ != 0) {
    held_.push_back(item);
  } else {
    log_.Write(item);
  }
}

void BusTap::WatchBoardClock(std::uint32_t device_us) {
  // A signed difference stands the wrap of 32 bits (every 71.6 min).
  if (device_us_ && static_cast<std::int32_t>(device_us - *device_us_) < 0) {
    log_.Alarm(
        fmt::format("{}the board's counter goes backwards, from {:.3f} to {:.3f} s: it "
                    "restarted unseen, or miscounts",
                    kInputsLost, *device_us_ * 1e-6, device_us * 1e-6));
  }
  device_us_ = device_us;
}

void BusTap::AddToMean(const ImuSample& sample) {
  if (!imu_degc_) return;
  const std::uint64_t second = sample.at_us / kSecond_us;
  if (second != sums_.second && sums_.n > 0) {
    const double n = sums_.n;
    MeanItem mean{.at_us = (sums_.second + 1) * kSecond_us,
                  .imu_degc = static_cast<float>(sums_.temperature / n),
                  .samples = sums_.n};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mean.raw_dps[axis] = static_cast<float>(sums_.raw[axis] / n);
      mean.rate_dps[axis] = static_cast<float>(sums_.rate[axis] / n);
      mean.accel_g[axis] = static_cast<float>(sums_.accel[axis] / n);
    }
    log_.Write(mean);
    sums_ = {};
  }
  sums_.second = second;
  const double lsb_dps = GyroLsb_dps(sample.raw_flags);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sums_.raw[axis] += sample.raw[axis] * lsb_dps;
    sums_.rate[axis] += sample.rate[axis] / 256.0;
    sums_.accel[axis] += sample.accel[axis] / 8000.0;
  }
  sums_.temperature += *imu_degc_;
  ++sums_.n;
}

}  // namespace zrobench
