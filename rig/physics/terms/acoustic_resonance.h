#pragma once
// A1: sound near the gyro's mechanical resonance shakes the sense mass; demodulated by the drive,
// it appears in the rate as a sinusoid.
#include <cstddef>

#include "rig/physics/term.h"

namespace zrobench::physics {

TermInfo AcousticResonanceInfo();

/// Where the resonance's parameters stand in its flat vector.
struct ResonanceLayout {
  static constexpr std::size_t kResonanceHz = 0;  ///< 3
  static constexpr std::size_t kQ = 3;
  static constexpr std::size_t kModeSplitHz = 4;
  static constexpr std::size_t kInjection = 5;  ///< 3
};

/// |H(f)| of a resonator 1 / (1 - (f/f_r)^2 + j f / (Q f_r)), divided by its value Q at f = f_r, so
/// that it is 1 there. The half-power width of |H|^2 is f_r / Q.
double ResonantGain(double tone_hz, double resonance_hz, double q);

}  // namespace zrobench::physics
