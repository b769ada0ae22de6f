#include "rig/physics/terms/thermal_series_mass.h"

#include <cmath>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kShare = 0, kTau = 1;

enum State : std::size_t { kMassDegc, kBoardDegc, kBoardSlope, kStates };

/// States: the mass [degC]; the board at the end of the last step [degC], and its slope [K/s]. The
/// board goes on with its slope while heat is reckoned, and is put right at the step's end: second
/// order, so that steps of a second do.
class ThermalSeriesMass final : public Term {
 public:
  void Place(const Temperatures& at, std::span<double> states) const override {
    states[kMassDegc] = states[kBoardDegc] = at.board_degc;
    states[kBoardSlope] = 0;
  }
  void Heat(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, HeatFlows& flows) const override {
    if (!context.model.package || context.dt_s <= 0) return;
    const double warmed_k = After(context.dt_s, parameters[kTau], states) - states[kMassDegc];
    const double behind_k = -parameters[kTau] * warmed_k / context.dt_s;  // mean of T_s - T_b
    flows.die_k_per_s += parameters[kShare] * behind_k / context.model.package->time_constant_s;
  }
  void Show(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, Temperatures&) const override {
    if (context.dt_s <= 0) return;
    const double board_degc = context.temperatures.board_degc;
    states[kBoardSlope] = (board_degc - states[kBoardDegc]) / context.dt_s;
    states[kMassDegc] = After(context.dt_s, parameters[kTau], states);
    states[kBoardDegc] = board_degc;
  }

 private:
  /// The mass behind a board that moves in a straight line.
  static double After(double dt_s, double tau_s, std::span<const double> states) {
    const double lag_k = tau_s * states[kBoardSlope];
    return states[kBoardDegc] + states[kBoardSlope] * dt_s - lag_k +
           (states[kMassDegc] - states[kBoardDegc] + lag_k) * std::exp(-dt_s / tau_s);
  }
};

}  // namespace

TermInfo ThermalSeriesMassInfo() {
  static const ThermalSeriesMass term;
  return {
      .id = "thermal.series_mass",
      .sentence =
          "A part of the die's heat passes another mass first (lid, potting): the die answers in "
          "two stages.",
      .equation = "tau_d T_d' = (1 - share) (T_b - T_d) + share (T_s - T_d), tau T_s' = T_b - T_s",
      .source =
          "lumped network, order chosen as in Bacher and Madsen, Energy and Buildings 43 (2011) "
          "1511; magnitudes: engineering estimate, tau 2 to 60 s",
      .parameters = {Single("share", "1", 0.3, "0: none; 1: all heat takes the longer path"),
                     Width("tau_s", "s", 15, "time constant of the mass", {2, 4, 8, 15, 30, 60})},
      .borrows = {},
      .channels = BoardChannels(),
      .lookalikes = {"thermal.dead_time", "time.latency", "thermal.die_sensor_hold",
                     "package time constant"},
      .excitation = "fast edges of the plate: two stages show as a flat beginning",
      .states = kStates,
      .term = &term,
      .needs = {"imu_degc", "plate_degc|drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
