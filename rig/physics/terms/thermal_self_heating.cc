#include "rig/physics/terms/thermal_self_heating.h"

#include <algorithm>

namespace zrobench::physics {
namespace {

constexpr std::size_t kIdleW = 0, kFullLoadW = 1;

class ThermalSelfHeating final : public Term {
 public:
  void Heat(const HeatContext& context, std::span<const double> parameters, std::span<double>,
            HeatFlows& flows) const override {
    if (!context.inputs.powered) return;
    const double share = std::clamp(context.inputs.load_pct, 0.0, 100.0) / 100;
    flows.board_w += parameters[kIdleW] + share * parameters[kFullLoadW];
  }
};

}  // namespace

TermInfo ThermalSelfHeatingInfo() {
  static const ThermalSelfHeating term;
  return {
      .id = "thermal.self_heating",
      .sentence =
          "The board's own electronics warm it while it is powered, the more the harder it works; "
          "the die follows the board, not the plate.",
      .equation = "C_b T_b' += idle_w + full_load_w load_pct / 100 while powered",
      .source =
          "energy balance of the board; magnitudes: engineering estimate (a controller with "
          "CAN idles at 50 to 300 mW, an application processor at work takes watts)",
      .parameters = {{"idle_w", "W", {0.15}, 0.1, true, false, "positive warms the board"},
                     {"full_load_w",
                      "W",
                      {5},
                      1,
                      true,
                      false,
                      "positive warms the board, at a load of 100 %"}},
      .borrows = {},
      .channels = {"imu_degc", "gyro_x_dps", "gyro_y_dps", "gyro_z_dps"},
      .lookalikes = {"gyro.warm_up", "gyro.supply", "thermal.ambient_drift",
                     "temperature sensor's offset"},
      .excitation = "power cycles and loads with the plate at rest",
      .states = 0,
      .term = &term,
      .needs = {"imu_degc", "plate_degc|drive_pct"},
  };
}

}  // namespace zrobench::physics
