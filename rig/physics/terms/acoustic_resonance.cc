#include "rig/physics/terms/acoustic_resonance.h"

#include <cmath>
#include <numbers>

#include "rig/physics/terms/resonator.h"

namespace zrobench::physics {
namespace {

using Layout = ResonanceLayout;

constexpr std::size_t kEnvelopes = 3;  ///< first of the resonators' states

/// States: the phase of each axis' beat, in turns 0 .. 1, then the resonators'. Moving a phase by
/// the unfolded beat frequency a sample makes the sampled sinusoid fold at sample_hz / 2 by itself,
/// and a phase that is a state stays continuous when the tone moves.
class AcousticResonance final : public Term {
 public:
  // The drive oscillator starts anew, and with it the beat.
  void PowerOn(std::span<double> states) const override {
    for (double& state : states) state = 0;
  }
  void Step(const TermContext& context, std::span<const double> parameters,
            std::span<double> states) const override {
    if (context.inputs.tone_pa == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double resonance_hz = parameters[Layout::kResonanceHz + axis] * context.resonance_scale;
      StepResonator(context, axis, resonance_hz, parameters[Layout::kQ],
                    states.subspan(kEnvelopes + axis * kResonatorStates, kResonatorStates));
      const double drive_hz = resonance_hz - parameters[Layout::kModeSplitHz];
      const double moved_hz =
          context.inputs.tone_band_hz > 0 ? resonance_hz : context.inputs.tone_hz;
      const double turns = states[axis] + (moved_hz - drive_hz) * context.sample_period_s;
      states[axis] = turns - std::floor(turns);
    }
  }
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double> states, Sensed& sensed) const override {
    if (context.inputs.tone_pa == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double resonance_hz = parameters[Layout::kResonanceHz + axis] * context.resonance_scale;
      const auto motion =
          MotionOf(context.inputs, resonance_hz, parameters[Layout::kQ],
                   states.subspan(kEnvelopes + axis * kResonatorStates, kResonatorStates));
      const double angle = 2 * std::numbers::pi * states[axis];
      const double swing = motion.in_phase * std::cos(angle) - motion.quadrature * std::sin(angle);
      sensed.rate_dps[axis] += parameters[Layout::kInjection + axis] * motion.pa * swing;
    }
  }
};

}  // namespace

TermInfo AcousticResonanceInfo() {
  static const AcousticResonance term;
  return {
      .id = "acoustic.resonance",
      .sentence =
          "Sound near an axis' mechanical resonance appears in its rate at the beat with the "
          "drive, "
          "folded by the sample rate: a tone as a sinusoid, a band of noise as noise.",
      .equation =
          "y = injection p |H(f)| cos(2 pi (f - f_d) t), f_d = resonance - mode_split, "
          "H(f) = 1 / (1 - (f/f_r)^2 + j f/(Q f_r)), |H(f_r)| scaled to 1",
      .source =
          "Son et al., USENIX Security 2015; drive frequencies: MPU-6000A datasheet 11.4.3; "
          "magnitudes: engineering estimate",
      .parameters =
          {{"resonance_hz", "Hz", {33000, 30000, 27000}, 30000, false, true, "centre of each axis"},
           {"q",
            "1",
            {450},
            450,
            false,
            true,
            "quality factor: half-power width is f_r / Q",
            {50, 150, 450, 1500, 5000}},
           {"mode_split_hz",
            "Hz",
            {1373},
            1000,
            false,
            false,
            "resonance above the drive frequency; 0 = a tone at resonance beats at 0 Hz",
            {0, 500, 1000, 1373, 3000}},
           {"injection_dps_per_pa",
            "dps/Pa",
            {0.06, 0.08, 0.15},
            0.1,
            true,
            false,
            "amplitude per rms pressure at resonance"}},
      .borrows = {},
      .channels = {"gyro_x_dps", "gyro_y_dps", "gyro_z_dps"},
      .lookalikes = {"acoustic.alias", "sound through the structure", "acoustic.harmonics"},
      .excitation = "tones in steps across the resonance, at two levels",
      .states = kEnvelopes + 3 * kResonatorStates,
      .term = &term,
      .needs = {"tone_hz", "tone_spl_db|tone_v", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .needs_every_sample = true,
  };
}

}  // namespace zrobench::physics
