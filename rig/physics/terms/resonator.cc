#include "rig/physics/terms/resonator.h"

#include <cmath>
#include <numbers>

namespace zrobench::physics {

double ResonantGain(double tone_hz, double resonance_hz, double q) {
  const double ratio = tone_hz / resonance_hz;
  const double stiffness = 1 - ratio * ratio;
  const double damping = ratio / q;
  return 1 / (q * std::sqrt(stiffness * stiffness + damping * damping));
}

double ResonantBandGain(double centre_hz, double band_hz, double resonance_hz, double q) {
  const double width_hz = resonance_hz / (2 * q);  // half of the half-power width
  const auto integral = [&](double hz) { return std::atan((hz - resonance_hz) / width_hz); };
  const double passed_hz =
      width_hz * (integral(centre_hz + band_hz / 2) - integral(centre_hz - band_hz / 2));
  return std::sqrt(passed_hz / band_hz);
}

void StepResonator(const TermContext& context, std::size_t axis, double resonance_hz, double q,
                   std::span<double> states) {
  if (context.inputs.tone_band_hz <= 0) return;
  const double kept = std::exp(-std::numbers::pi * resonance_hz * context.sample_period_s / q);
  const double kick = std::sqrt((1 - kept * kept) / 2);
  for (std::size_t i = 0; i < kResonatorStates; ++i) {
    states[i] = kept * states[i] + kick * context.normals[axis][i];
  }
}

ResonatorMotion MotionOf(const Inputs& inputs, double resonance_hz, double q,
                         std::span<const double> states) {
  if (inputs.tone_band_hz <= 0) {
    return {inputs.tone_pa * ResonantGain(inputs.tone_hz, resonance_hz, q)};
  }
  const double gain = ResonantBandGain(inputs.tone_hz, inputs.tone_band_hz, resonance_hz, q);
  return {inputs.tone_pa * gain, states[0], states[1]};
}

}  // namespace zrobench::physics
