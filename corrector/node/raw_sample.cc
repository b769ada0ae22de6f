#include "corrector/node/raw_sample.h"

#include "corrector/node/codec.h"

namespace zro::node {

// Exact or correctly rounded on every IEEE-754 machine: 125 * word stays below 2^23 and the rest of
// the gyro's scale is a power of two (exact), temperature likewise; the accelerometer takes one
// division, which IEEE-754 rounds correctly.
Sample ToSample(const RawSample& raw, std::uint16_t previous_counter, bool first) {
  const float range = static_cast<float>(1 << (raw.range_code & 0xF)) / 32768.0f;
  Sample s{};
  for (int i = 0; i < kAxes; ++i) {
    s.rate_dps[i] = static_cast<float>(raw.gyro[i] * 125) * range;
    s.accel_g[i] = static_cast<float>(raw.accel[i]) / kAccelLsbPerG;
    s.gyro_clipped = s.gyro_clipped || raw.gyro[i] == 32767 || raw.gyro[i] == -32768;
  }
  s.temp_degc = static_cast<float>(raw.temperature) * kDegcPerTempLsb;
  s.elapsed = Elapsed(raw.counter, previous_counter, first);
  s.accel_clipped = raw.accel_clipped;
  s.overrun = raw.overrun;
  return s;
}

}  // namespace zro::node
