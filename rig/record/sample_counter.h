#pragma once
#include <cstdint>

#include "corrector/node/raw_sample.h"
#include "rig/record/item.h"

namespace zrobench {

/// Finds a sample's 16-bit counter: DUT_TIME names it for the next sample, the sequence byte of
/// DUT_RAW counts on from there. More than 255 samples lost between two DUT_TIME go unseen.
class SampleCounter {
 public:
  void Take(const ImuTime& time) {
    announced_ = true;
    next_ = time.counter;
  }
  /// The sample's counter.
  std::uint16_t Take(const ImuSample& sample) {
    const bool named = announced_ && static_cast<std::uint8_t>(next_) == sample.seq;
    const std::uint16_t before = counter_;
    if (named) {
      counter_ = next_;
    } else if (known_) {
      counter_ = static_cast<std::uint16_t>(
          counter_ + static_cast<std::uint8_t>(sample.seq - static_cast<std::uint8_t>(counter_)));
    } else {
      counter_ = sample.seq;
    }
    missing_ = known_ ? static_cast<std::uint16_t>(counter_ - before - 1) : std::uint16_t{0};
    announced_ = false;
    known_ = true;
    return counter_;
  }
  /// Samples missing in front of the last one taken.
  std::uint16_t missing() const { return missing_; }

 private:
  std::uint16_t counter_ = 0, next_ = 0, missing_ = 0;
  bool announced_ = false, known_ = false;
};

/// The integers of a recorded sample as the board had them. `temperature` as of the last DUT_TIME.
inline zro::node::RawSample ToRaw(const ImuSample& sample, std::uint16_t counter,
                                  std::int16_t temperature) {
  zro::node::RawSample raw{};
  for (std::size_t i = 0; i < 3; ++i) {
    raw.gyro[i] = sample.raw[i];
    raw.accel[i] = sample.accel[i];
  }
  raw.temperature = temperature;
  raw.counter = counter;
  raw.range_code = sample.raw_flags & 0x0F;
  raw.overrun = (sample.raw_flags & 0x10) != 0;
  raw.accel_clipped = (sample.accel_flags & 0x01) != 0;
  return raw;
}

}  // namespace zrobench
