#include "rig/physics/terms/acoustic_alias.h"

#include "rig/physics/terms/resonant_swing.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kDpsPerPa = 0;  // 3
constexpr std::size_t kClockPpmPerK = 3, kClockReferenceDegc = 4;
constexpr std::size_t kBorrowed = 5;  // the resonance's own

/// The phase moves by f times the gyro's own sample period: that is the folding. The clock is the
/// gyro's own oscillator and runs with the die's temperature.
class AcousticAlias final : public ResonantSwing {
 public:
  AcousticAlias() : ResonantSwing(kBorrowed, kDpsPerPa) {}

 protected:
  double Turns(const TermContext& context, std::span<const double> parameters, double moved_hz,
               double) const override {
    const double warmer_k = context.temperatures.die_degc - parameters[kClockReferenceDegc];
    const double period_s =
        context.sample_period_s / (1 + 1e-6 * parameters[kClockPpmPerK] * warmer_k);
    return moved_hz * period_s;
  }
};

}  // namespace

TermInfo AcousticAliasInfo() {
  static const AcousticAlias term;
  return {
      .id = "acoustic.alias",
      .sentence =
          "Sound near an axis' resonance, sampled without demodulation, folds at the output data "
          "rate into a line that moves with the gyro's clock: a slow beat, or an offset.",
      .equation =
          "y = dps_per_pa p |H(f)| cos(2 pi |f - n f_s| t), n = round(f / f_s), "
          "f_s = sample_hz (1 + 1e-6 clock_ppm_per_k (T_d - clock_reference)), "
          "H as in acoustic.resonance",
      .source =
          "Trippel et al., WALNUT, IEEE EuroS&P 2017; Tu et al., Injected and Delivered, USENIX "
          "Security 2018 (sample clock drift moves the alias); magnitudes: engineering estimate",
      .parameters = {{"dps_per_pa",
                      "dps/Pa",
                      {0.02, 0.02, 0.03},
                      0.03,
                      true,
                      false,
                      "amplitude per rms pressure at resonance"},
                     {"clock_ppm_per_k",
                      "1e-6/K",
                      {100},
                      100,
                      false,
                      false,
                      "positive: the gyro samples faster when warm",
                      {50, 100, 200, 300}},
                     {"clock_reference_degc",
                      "degC",
                      {25},
                      25,
                      false,
                      false,
                      "die temperature at which the clock is right",
                      {25}}},
      .borrows = "acoustic.resonance",
      .channels = {"gyro_x_dps", "gyro_y_dps", "gyro_z_dps"},
      .lookalikes = {"acoustic.rectification", "acoustic.resonance"},
      .excitation = "tones near resonance, moved by 1 Hz, at two temperatures",
      .states = ResonantSwing::kStates,
      .term = &term,
      .needs = {"tone_hz", "tone_spl_db|tone_v", "imu_degc", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .needs_every_sample = true,
  };
}

}  // namespace zrobench::physics
