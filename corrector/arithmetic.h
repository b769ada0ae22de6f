#pragma once
// The little arithmetic the corrector needs. Of libm: fabsf and sqrtf only (other functions differ
// between C libraries, and host and target must agree bit for bit).
#include <math.h>

#include <cstdint>

#include "corrector/types.h"

namespace zro {

/// False for NaN, infinities and what no sensor can mean.
inline bool IsSane(float x, float magnitude) { return fabsf(x) <= magnitude; }

inline float Max(float a, float b) { return a > b ? a : b; }
inline float Min(float a, float b) { return a < b ? a : b; }
inline float Clamp(float x, float low, float high) { return x < low ? low : (x > high ? high : x); }
inline float Square(float x) { return x * x; }

/// Greatest integer not above x; |x| well inside int.
inline int Floor(float x) {
  const int truncated = static_cast<int>(x);
  return static_cast<float>(truncated) > x ? truncated - 1 : truncated;
}

/// Samples in a time, at least one.
inline std::uint32_t SamplesIn(float seconds, float sample_hz) {
  const float n = seconds * sample_hz + 0.5f;
  return n < 1.0f ? 1u : static_cast<std::uint32_t>(n);
}

/// An axis and the magnitude found on it.
struct Worst {
  float value;
  std::uint8_t axis;
};

/// The axis on which two vectors differ most.
inline Worst WorstDifference(const float a[kAxes], const float b[kAxes]) {
  Worst worst{-1.0f, kNoAxis};
  for (int i = 0; i < kAxes; ++i) {
    const float difference = fabsf(a[i] - b[i]);
    if (difference > worst.value) worst = {difference, static_cast<std::uint8_t>(i)};
  }
  return worst;
}

}  // namespace zro
