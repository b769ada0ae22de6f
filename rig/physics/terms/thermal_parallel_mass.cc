#include "rig/physics/terms/thermal_parallel_mass.h"

#include <cmath>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kWPerK = 0, kTau = 1;

/// State: the mass's temperature [degC]; without a board, board and plate are one.
class ThermalParallelMass final : public Term {
 public:
  void Place(const Temperatures& at, std::span<double> states) const override {
    states[0] = at.board_degc;
  }
  void Heat(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, HeatFlows& flows) const override {
    if (context.dt_s <= 0) return;
    // Exact for the board's temperature held over the step; what the mass takes, the board loses.
    const double tau_s = parameters[kTau];
    const double warmed_k =
        (context.temperatures.board_degc - states[0]) * -std::expm1(-context.dt_s / tau_s);
    states[0] += warmed_k;
    flows.board_w -= parameters[kWPerK] * tau_s * warmed_k / context.dt_s;
  }
};

}  // namespace

TermInfo ThermalParallelMassInfo() {
  static const ThermalParallelMass term;
  return {
      .id = "thermal.parallel_mass",
      .sentence =
          "A mass beside the path of heat (connector, cable, fixture) warms slowly and takes its "
          "heat from the board: a slow tail after each step.",
      .equation =
          "C_b T_b' -= w_per_k (T_b - T_m), tau T_m' = T_b - T_m; without a board, at the plate",
      .source =
          "lumped network of one more node; magnitudes: engineering estimate, w_per_k / C_b 1e-5 "
          "to 1e-3 1/s, tau 100 to 1500 s",
      .parameters = {Single("w_per_k", "W/K", 0.003, "positive: heat flows from warm to cold"),
                     Width("tau_s", "s", 600, "time constant of the mass",
                           {100, 200, 400, 800, 1600})},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"gyro.creep", "thermal.ambient_drift", "thermal.series_mass"},
      .excitation = "steps with long holds, the same step again after another rest",
      .states = 1,
      .term = &term,
      .needs = {"imu_degc|plate_degc", "plate_degc|drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
