#include "rig/physics/terms/acoustic_rectification.h"

#include "rig/physics/terms/acoustic_resonance.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kDpsPerPa2 = 0;  // 3, then the resonance's own
constexpr std::size_t kResonanceHz = 3 + ResonanceLayout::kResonanceHz;
constexpr std::size_t kQ = 3 + ResonanceLayout::kQ;

class AcousticRectification final : public Term {
 public:
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double>, Sensed& sensed) const override {
    const double tone_pa = context.inputs.tone_pa;
    if (tone_pa == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double moved = tone_pa * ResonantGain(context.inputs.tone_hz,
                                                  parameters[kResonanceHz + axis], parameters[kQ]);
      sensed.rate_dps[axis] += parameters[kDpsPerPa2 + axis] * moved * moved;
    }
  }
};

}  // namespace

TermInfo AcousticRectificationInfo() {
  static const AcousticRectification term;
  return {
      .id = "acoustic.rectification",
      .sentence =
          "While a tone excites an axis' resonance, its rate shifts by a constant that "
          "grows with the square of the sound pressure.",
      .equation = "y = dps_per_pa2 p^2 |H(f)|^2, H as in acoustic.resonance",
      .source =
          "the quadratic law: Sensors 2021 21(3) 945 for an accelerometer; magnitude: "
          "engineering estimate",
      .parameters = {{"dps_per_pa2",
                      "dps/Pa^2",
                      {0.03, 0.04, 0.075},
                      0.075,
                      true,
                      false,
                      "positive shifts the rate up"}},
      .borrows = "acoustic.resonance",
      .channels = {"gyro_x_dps", "gyro_y_dps", "gyro_z_dps"},
      .lookalikes = {"acoustic.alias", "gyro.vibration_rectification", "acoustic.emi"},
      .excitation = "tone bursts on and off at resonance, at two levels",
      .states = 0,
      .term = &term,
  };
}

}  // namespace zrobench::physics
