#pragma once
// How a sensor's number leaves it: as a whole number of steps, and no more than fits.
#include <cstdint>

namespace zrobench::physics {

struct SensorWord {
  std::int16_t word = 0;
  bool clipped = false;  ///< the value lay beyond the word's range
};

/// `value` in steps of `lsb` (> 0, same unit), rounded to nearest (halves away from zero) and
/// saturated at -32768 .. 32767. A value that is not a number becomes 0, clipped.
SensorWord QuantiseToWord(double value, double lsb);

/// `value` rounded to the nearest multiple of `resolution` (same unit); 0 = no quantisation.
double Quantise(double value, double resolution);

}  // namespace zrobench::physics
