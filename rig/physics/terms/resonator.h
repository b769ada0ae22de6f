#pragma once
// What a tone or a band of noise does to one mechanical resonance: shared by all acoustic terms.
#include <span>

#include "rig/physics/term.h"

namespace zrobench::physics {

/// |H(f)| of a resonator 1 / (1 - (f/f_r)^2 + j f / (Q f_r)), divided by its value Q at f = f_r, so
/// that it is 1 there. The half-power width of |H|^2 is f_r / Q.
double ResonantGain(double tone_hz, double resonance_hz, double q);

/// The same for noise, flat over `band_hz` about `centre_hz`: root of the share of its energy that
/// the resonance passes. |H|^2 near its peak is a Lorentzian, whose integral is closed: with
/// g(f) = atan(2 Q (f - f_r) / f_r) the share is f_r / (2 Q band) (g(high) - g(low)); all of the
/// resonance inside the band leaves its noise bandwidth, pi f_r / (2 Q), over the band's.
double ResonantBandGain(double centre_hz, double band_hz, double resonance_hz, double q);

/// How one resonance moves under the sound of `inputs`: a sinusoid, scaled as a tone on the peak of
/// rms pressure `pa` would move it, times an envelope of mean square 1.
struct ResonatorMotion {
  double pa = 0;
  double in_phase = 1, quadrature = 0;  ///< envelope; constant for a tone
  double power() const { return pa * pa * (in_phase * in_phase + quadrature * quadrature); }
};

/// States that a resonator needs: the envelope of its answer to noise.
inline constexpr std::size_t kResonatorStates = 2;
/// Those of one axis, in the states of all three.
template <typename T>
std::span<T> EnvelopeOf(std::size_t axis, std::span<T> all) {
  return all.subspan(axis * kResonatorStates, kResonatorStates);
}

/// Moves an axis' envelope on by a sample while noise sounds. Noise through a resonance is a
/// carrier at f_r whose envelope is a complex Gaussian process that forgets within Q / (pi f_r),
/// some 5 ms: y[n+1] = a y[n] + sqrt((1 - a^2) / 2) (n_1 + j n_2), a = exp(-pi f_r dt / Q). Terms
/// on the same resonance see the same envelope.
void StepResonator(const TermContext& context, std::size_t axis, double resonance_hz, double q,
                   std::span<double> states);
ResonatorMotion MotionOf(const Inputs& inputs, double resonance_hz, double q,
                         std::span<const double> states);

}  // namespace zrobench::physics
