#include "rig/physics/terms/acoustic_power_compression.h"

#include <cmath>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kPerPa2 = 0, kTau = 1;

/// State: what warms the coil, the square of the pressure played, smoothed [Pa^2]. The board's
/// power does not touch it.
class AcousticPowerCompression final : public Term {
 public:
  void Place(const Temperatures&, std::span<double> states) const override { states[0] = 0; }
  void Sound(const TermContext& context, std::span<const double> parameters,
             std::span<double> states, Heard& heard) const override {
    const double played_pa = context.inputs.tone_pa;
    states[0] += (played_pa * played_pa - states[0]) *
                 -std::expm1(-context.sample_period_s / parameters[kTau]);
    heard.tone_pa /= 1 + parameters[kPerPa2] * states[0];
  }
};

}  // namespace

TermInfo AcousticPowerCompressionInfo() {
  static const AcousticPowerCompression term;
  return {
      .id = "acoustic.power_compression",
      .sentence =
          "The speaker's coil warms as it plays, its resistance grows, and the sound gets quieter.",
      .equation = "p -> p / (1 + per_pa2 theta), tau theta' = p^2 - theta",
      .source =
          "copper: +0.39 %/K, so that +180 K costs 4.7 dB; coil 1 to 10 s, magnet 10 to 60 min "
          "(engineering estimate)",
      .parameters = {Amount("per_pa2", "1/Pa^2", 0.05,
                            "how much the resistance grows in the end, per square of pressure"),
                     Width("tau_s", "s", 5, "time constant of coil or magnet",
                           {2, 5, 15, 60, 600, 1800})},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"acoustic.resonance_drift", "acoustic.harmonics"},
      .excitation = "long bursts at two levels, with pauses",
      .states = 1,
      .term = &term,
      .needs = {"tone_hz", "tone_spl_db|tone_v", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
