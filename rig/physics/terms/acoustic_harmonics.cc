#include "rig/physics/terms/acoustic_harmonics.h"

#include <cmath>

#include "rig/physics/terms/acoustic_resonance.h"
#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/resonator.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kSecond = 0, kThird = 1;
constexpr std::size_t kDpsPerPa2 = 2;  // 3: the rectification's
constexpr std::size_t kBorrowed = 5;   // the resonance's own

/// Of a tone; what noise is distorted into stays spread and weak.
class AcousticHarmonics final : public Term {
 public:
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double>, Sensed& sensed) const override {
    const Inputs& inputs = context.inputs;
    if (inputs.tone_pa == 0 || inputs.tone_band_hz > 0) return;
    const double pa2 = inputs.tone_pa * inputs.tone_pa;
    const double second_pa2 = parameters[kSecond] * pa2 * pa2;
    const double third_pa2 = parameters[kThird] * pa2 * pa2 * pa2;
    const auto resonance = parameters.subspan(kBorrowed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double resonance_hz = ResonanceHz(context, resonance, axis);
      const auto passed = [&](double hz) {
        return std::pow(ResonantGain(hz, resonance_hz, resonance[ResonanceLayout::kQ]), 2);
      };
      sensed.rate_dps[axis] +=
          parameters[kDpsPerPa2 + axis] *
          (second_pa2 * passed(2 * inputs.tone_hz) + third_pa2 * passed(3 * inputs.tone_hz));
    }
  }
};

}  // namespace

TermInfo AcousticHarmonicsInfo() {
  static const AcousticHarmonics term;
  return {
      .id = "acoustic.harmonics",
      .sentence =
          "The speaker distorts: twice or three times its tone meets a resonance, and shifts the "
          "rate as a tone there would.",
      .equation =
          "y = dps_per_pa2 (second p^4 |H(2f)|^2 + third p^6 |H(3f)|^2): shares of the tone's "
          "energy at 1 Pa, which grow with p^2 and p^4; dps_per_pa2 and H as in "
          "acoustic.rectification",
      .source =
          "total harmonic distortion of small speakers 0.1 to 10 % (engineering estimate): "
          "energies of 1e-6 to 1e-2",
      .parameters = {{"second",
                      "1/Pa^2",
                      {1e-3},
                      1e-3,
                      true,
                      false,
                      "energy at twice the tone over the tone's, at 1 Pa"},
                     {"third",
                      "1/Pa^4",
                      {1e-3},
                      1e-3,
                      true,
                      false,
                      "energy at three times the tone over the tone's, at 1 Pa"}},
      .borrows = "acoustic.rectification",
      .channels = GyroChannels(),
      .lookalikes = {"acoustic.rectification", "acoustic.resonance"},
      .excitation = "tones at a half and a third of a resonance, at two levels",
      .states = 0,
      .term = &term,
      .needs = {"tone_hz", "tone_spl_db|tone_v", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
