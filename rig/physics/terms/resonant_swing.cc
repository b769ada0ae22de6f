#include "rig/physics/terms/resonant_swing.h"

#include <cmath>
#include <numbers>

#include "rig/physics/terms/acoustic_resonance.h"
#include "rig/physics/terms/resonator.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kEnvelopes = 3;  ///< first of the resonators' states
static_assert(ResonantSwing::kStates == kEnvelopes + 3 * kResonatorStates);

}  // namespace

void ResonantSwing::PowerOn(std::span<double> states) const {
  for (double& state : states) state = 0;
}

void ResonantSwing::Step(const TermContext& context, std::span<const double> parameters,
                         std::span<double> states) const {
  const Inputs& inputs = context.inputs;
  if (inputs.tone_pa == 0) return;
  const auto resonance = parameters.subspan(resonance_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double resonance_hz = ResonanceHz(context, resonance, axis);
    StepResonator(context, axis, resonance_hz, resonance[ResonanceLayout::kQ],
                  EnvelopeOf(axis, states.subspan(kEnvelopes)));
    const double moved_hz = inputs.tone_band_hz > 0 ? resonance_hz : inputs.tone_hz;
    const double turns = states[axis] + Turns(context, parameters, moved_hz, resonance_hz);
    states[axis] = turns - std::floor(turns);
  }
}

void ResonantSwing::Output(const TermContext& context, std::span<const double> parameters,
                           std::span<const double> states, Sensed& sensed) const {
  if (context.inputs.tone_pa == 0) return;
  const auto resonance = parameters.subspan(resonance_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto motion =
        MotionOf(context.inputs, ResonanceHz(context, resonance, axis),
                 resonance[ResonanceLayout::kQ], EnvelopeOf(axis, states.subspan(kEnvelopes)));
    const double angle = 2 * std::numbers::pi * states[axis];
    const double swing = motion.in_phase * std::cos(angle) - motion.quadrature * std::sin(angle);
    sensed.rate_dps[axis] += parameters[dps_per_pa_ + axis] * motion.pa * swing;
  }
}

}  // namespace zrobench::physics
