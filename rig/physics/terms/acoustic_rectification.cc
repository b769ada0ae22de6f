#include "rig/physics/terms/acoustic_rectification.h"

#include "rig/physics/terms/acoustic_resonance.h"
#include "rig/physics/terms/resonator.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kDpsPerPa2 = 0;  // 3
constexpr std::size_t kBorrowed = 3;   // the resonance's own

class AcousticRectification final : public Term {
 public:
  void Step(const TermContext& context, std::span<const double> parameters,
            std::span<double> states) const override {
    if (context.inputs.tone_pa == 0) return;
    const auto resonance = parameters.subspan(kBorrowed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      StepResonator(context, axis, ResonanceHz(context, resonance, axis),
                    resonance[ResonanceLayout::kQ], EnvelopeOf(axis, states));
    }
  }
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double> states, Sensed& sensed) const override {
    const Inputs& inputs = context.inputs;
    if (inputs.tone_pa == 0) return;
    const auto resonance = parameters.subspan(kBorrowed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto motion = MotionOf(inputs, ResonanceHz(context, resonance, axis),
                                   resonance[ResonanceLayout::kQ], EnvelopeOf(axis, states));
      sensed.rate_dps[axis] += parameters[kDpsPerPa2 + axis] * motion.power();
    }
  }
};

}  // namespace

TermInfo AcousticRectificationInfo() {
  static const AcousticRectification term;
  return {
      .id = "acoustic.rectification",
      .sentence =
          "While sound excites an axis' resonance, its rate shifts by a constant that grows with "
          "the square of the sound pressure there; noise in a band shifts it by its energy.",
      .equation =
          "y = dps_per_pa2 p^2 |H(f)|^2, H as in acoustic.resonance; for noise the energy that H "
          "passes",
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
      .lookalikes = {"acoustic.alias", "acoustic.harmonics", "gyro.vibration_rectification",
                     "the speaker's current in the supply"},
      .excitation = "tone bursts on and off at resonance, at two levels",
      .states = 3 * kResonatorStates,
      .term = &term,
      .needs = {"tone_hz", "tone_spl_db|tone_v", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
