#pragma once
// The integers of one sensor instant, as they go over the bus, and the one way to make a corrector
// input of them: board, firmware and host oracle share it, so that they agree bit for bit.
#include <cstdint>

#include "corrector/types.h"

namespace zro::node {

struct RawSample {
  std::int16_t gyro[kAxes];   ///< LSB = 125 * 2^range_code / 32768 dps
  std::int16_t accel[kAxes];  ///< LSB = 0.000125 g
  std::int16_t temperature;   ///< LSB = 1/256 degC; the last one sent (DUT_TIME)
  std::uint16_t counter;      ///< 16-bit sample counter
  std::uint8_t range_code;    ///< 0..5
  bool overrun;
  bool accel_clipped;
};

/// Sample periods since the previous sample; 1 for the first after a boot. A counter that stands
/// still has gone round once: never "no time at all".
inline std::uint32_t Elapsed(std::uint16_t counter, std::uint16_t previous_counter, bool first) {
  const auto periods = static_cast<std::uint16_t>(counter - previous_counter);
  return first ? 1 : periods == 0 ? 65536u : periods;
}

/// Scales to units. `previous_counter` gives Sample::elapsed; pass `first` for the first sample
/// after a boot (elapsed = 1). A gyro word at either end of its range counts as clipped.
Sample ToSample(const RawSample& raw, std::uint16_t previous_counter, bool first);

}  // namespace zro::node
