#include "rig/physics/terms/acoustic_resonance_drift.h"

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr double kReferenceDegc = 25;

class AcousticResonanceDrift final : public Term {
 public:
  void Sound(const TermContext& context, std::span<const double> parameters, std::span<double>,
             Heard& heard) const override {
    heard.resonance_scale *=
        1 + 1e-6 * parameters[0] * (context.temperatures.die_degc - kReferenceDegc);
  }
};

}  // namespace

TermInfo AcousticResonanceDriftInfo() {
  static const AcousticResonanceDrift term;
  return {
      .id = "acoustic.resonance_drift",
      .sentence =
          "The gyro's resonances move with its temperature: a tone beside one passes through it by "
          "heating alone.",
      .equation =
          "f_r -> f_r (1 + 1e-6 ppm_per_k (T_d - 25)), and the drive with it, in every acoustic "
          "term of the model",
      .source =
          "Sensors 2009 9(10) 8349: the frequency falls linearly with temperature; magnitude: half "
          "of silicon's -60 ppm/K of Young's modulus (engineering estimate)",
      .parameters = {{"ppm_per_k",
                      "1e-6/K",
                      {-30},
                      30,
                      true,
                      false,
                      "negative: resonances sink as it warms"}},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.temperature_curve", "acoustic.power_compression"},
      .excitation = "one tone beside a resonance, on and off, over a ramp",
      .states = 0,
      .term = &term,
      .needs = {"tone_hz", "tone_spl_db|tone_v", "imu_degc", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
