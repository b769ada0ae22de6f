#pragma once
// How a resonance's motion shows in the rate as a sinusoid: shared by those that demodulate it and
// those that only sample it.
#include "rig/physics/term.h"

namespace zrobench::physics {

/// rate[axis] += dps_per_pa[axis] * pressure * the motion of that axis' resonance. States: the
/// phase of each axis' motion, in turns 0 .. 1, then the resonators'. A phase that moves on by
/// whole and part turns a sample makes the sinusoid fold at the sample rate by itself, and stays
/// continuous when the tone moves.
class ResonantSwing : public Term {
 public:
  static constexpr std::size_t kStates = 9;

  // The drive oscillator starts anew, and with it the beat.
  void PowerOn(std::span<double> states) const final;
  void Step(const TermContext& context, std::span<const double> parameters,
            std::span<double> states) const final;
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double> states, Sensed& sensed) const final;

 protected:
  /// Where acoustic.resonance's parameters begin, and where the three amplitudes stand [dps/Pa].
  ResonantSwing(std::size_t resonance, std::size_t dps_per_pa)
      : resonance_(resonance), dps_per_pa_(dps_per_pa) {}
  /// By how many turns the phase moves in a sample while the axis, of a resonance at
  /// `resonance_hz`, swings at `moved_hz`.
  virtual double Turns(const TermContext& context, std::span<const double> parameters,
                       double moved_hz, double resonance_hz) const = 0;

 private:
  std::size_t resonance_, dps_per_pa_;
};

}  // namespace zrobench::physics
