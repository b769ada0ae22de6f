#pragma once
// Were the raw values of a reading stable? (fig. 4, 38-40: averages of values known to be stable)
#include "corrector/config.h"
#include "corrector/noise_floor.h"
#include "corrector/reading.h"
#include "corrector/types.h"

namespace zro {

/// A code with the numbers behind it; value and limit share the unit of the code's quantity.
struct Finding {
  Code code = Code::kNone;
  std::uint8_t axis = kNoAxis;
  float value = 0.0f;
  float limit = 0.0f;
};

/// First reason, in fixed order, to refuse the reading before its value is looked at: 11 gap,
/// 9 clipped, 7 temperature sensor, 6 temperature range, 5 slope, 2 and 10 gyro noise, 2 drift
/// within the window, 3 bias. kNone when there is none.
Finding AssessQuality(const Summary& reading, const Limits& limits, const NoiseFloor& floor);

/// False for NaN and for what no silicon sensor survives.
bool IsPhysicalTemperature(float temp_degc);

}  // namespace zro
