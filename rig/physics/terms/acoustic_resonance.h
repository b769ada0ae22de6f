#pragma once
// A1: sound near the gyro's mechanical resonance shakes the sense mass; demodulated by the drive,
// it appears in the rate as a sinusoid.
#include <cstddef>
#include <span>

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

/// Where an axis' resonance stands now. `resonance`: parameters that begin with
/// acoustic.resonance's.
inline double ResonanceHz(const TermContext& context, std::span<const double> resonance,
                          std::size_t axis) {
  return resonance[ResonanceLayout::kResonanceHz + axis] * context.resonance_scale;
}

}  // namespace zrobench::physics
