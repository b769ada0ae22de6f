#include "rig/physics/terms/gyro_hysteresis.h"

#include <array>

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/play.h"

namespace zrobench::physics {
namespace {

constexpr std::array kWidthsK = {1.0, 2.5, 6.0, 15.0};
constexpr double kReferenceDegc = 25, kSpanK = 40;

/// States: the plays' positions [degC].
class GyroHysteresis final : public Term {
 public:
  void PowerOn(std::span<double> states) const override {
    for (double& state : states) state = kPlayAtRest;
  }
  void Step(const TermContext& context, std::span<const double>,
            std::span<double> states) const override {
    for (std::size_t i = 0; i < kWidthsK.size(); ++i) {
      states[i] = MovedPlay(states[i], context.temperatures.die_degc, kWidthsK[i]);
    }
  }
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double> states, Sensed& sensed) const override {
    for (std::size_t i = 0; i < kWidthsK.size(); ++i) {
      const double play_degc = MovedPlay(states[i], context.temperatures.die_degc, kWidthsK[i]);
      const double span = (play_degc - kReferenceDegc) / kSpanK;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sensed.rate_dps[axis] += parameters[3 * i + axis] * span;
      }
    }
  }
};

ParameterInfo Weight(std::string_view name) {
  return PerAxis(name, "dps/40K", 0.01, "positive: the rate grows with the temperature");
}

}  // namespace

TermInfo GyroHysteresisInfo() {
  static const GyroHysteresis term;
  return {
      .id = "gyro.hysteresis",
      .sentence =
          "Many small gaps act together: the offset's loops over temperature are round, and small "
          "loops nest within large ones.",
      .equation =
          "y = sum_i c_i (p_i - 25) / 40, p_i = clamp(p_i, T_d - w_i, T_d + w_i), w = 1, 2.5, 6, "
          "15 K; p_i = T_d at power-on",
      .source =
          "Prandtl-Ishlinskii operator: plays of fixed widths, linear in their weights (Brokate "
          "and Sprekels 1996); magnitudes: engineering estimate",
      .parameters = {Weight("dps_per_40k_at_1k"), Weight("dps_per_40k_at_2k5"),
                     Weight("dps_per_40k_at_6k"), Weight("dps_per_40k_at_15k")},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.backlash", "gyro.creep", "gyro.temperature_curve"},
      .excitation = "loops of several sizes through the same temperatures, one within the other",
      .states = kWidthsK.size(),
      .term = &term,
      .needs = {"imu_degc", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
