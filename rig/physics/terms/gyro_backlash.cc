#include "rig/physics/terms/gyro_backlash.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/per_axis_term.h"
#include "rig/physics/terms/play.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kWidth = 3;
constexpr double kReferenceDegc = 25, kSpanK = 40;

/// State: the play's position [degC].
class GyroBacklash final : public PerAxisTerm {
 public:
  void PowerOn(std::span<double> states) const override { states[0] = kPlayAtRest; }
  void Step(const TermContext& context, std::span<const double> parameters,
            std::span<double> states) const override {
    states[0] = MovedPlay(states[0], context.temperatures.die_degc, parameters[kWidth]);
  }

 protected:
  double Cause(const TermContext& context, std::span<const double> parameters,
               std::span<const double> states) const override {
    const double play_degc =
        MovedPlay(states[0], context.temperatures.die_degc, parameters[kWidth]);
    return (play_degc - kReferenceDegc) / kSpanK;
  }
};

}  // namespace

TermInfo GyroBacklashInfo() {
  static const GyroBacklash term;
  return {
      .id = "gyro.backlash",
      .sentence =
          "The offset follows the temperature only after it has moved through a gap: warming and "
          "cooling give two values at the same temperature, however slowly it moves.",
      .equation =
          "y = dps_per_40k (p - 25) / 40, p = clamp(p, T_d - width, T_d + width), p = T_d at "
          "power-on; the loop is 2 width wide",
      .source =
          "the play operator of hysteresis theory (Krasnosel'skii and Pokrovskii 1989); "
          "magnitudes: engineering estimate, loops of 1 to 30 mdps",
      .parameters = {PerAxis("dps_per_40k", "dps/40K", 0.04,
                             "positive: the rate grows with the temperature it lags behind"),
                     Width("width_k", "K", 5, "half of the gap", {1, 2, 3, 5, 7, 10})},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"gyro.creep", "gyro.hysteresis", "gyro.temperature_rate"},
      .excitation =
          "up and down through the same temperatures at two rates, with holds: play neither knows "
          "the rate nor moves in a hold",
      .states = 1,
      .term = &term,
      .needs = {"imu_degc", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
