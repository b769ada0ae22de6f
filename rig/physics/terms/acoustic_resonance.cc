#include "rig/physics/terms/acoustic_resonance.h"

#include "rig/physics/terms/resonant_swing.h"

namespace zrobench::physics {
namespace {

/// The phase is that of the beat with the drive, which stands beside the resonance.
class AcousticResonance final : public ResonantSwing {
 public:
  AcousticResonance() : ResonantSwing(0, ResonanceLayout::kInjection) {}

 protected:
  double Turns(const TermContext& context, std::span<const double> parameters, double moved_hz,
               double resonance_hz) const override {
    const double drive_hz = resonance_hz - parameters[ResonanceLayout::kModeSplitHz];
    return (moved_hz - drive_hz) * context.sample_period_s;
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
      .states = ResonantSwing::kStates,
      .term = &term,
      .needs = {"tone_hz", "tone_spl_db|tone_v", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .needs_every_sample = true,
  };
}

}  // namespace zrobench::physics
