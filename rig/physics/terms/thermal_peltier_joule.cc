#include "rig/physics/terms/thermal_peltier_joule.h"

#include <algorithm>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

class ThermalPeltierJoule final : public Term {
 public:
  void Heat(const HeatContext& context, std::span<const double> parameters, std::span<double>,
            HeatFlows& flows) const override {
    const double share = std::clamp(context.drive_pct, -100.0, 100.0) / 100;
    flows.plate_w += parameters[0] * share * share;
  }
};

}  // namespace

TermInfo ThermalPeltierJouleInfo() {
  static const ThermalPeltierJoule term;
  return {
      .id = "thermal.peltier_joule",
      .sentence =
          "Half of the heat that the Peltier module makes of its current arrives at the plate, "
          "whichever way it pumps: heating gains, cooling loses, with the square.",
      .equation = "C_p T_p' += joule_w (drive / 100)^2; joule_w = I^2 R / 2 at full drive",
      .source =
          "Peltier module: Q = alpha I T +- I^2 R / 2 - K dT (Lineykin and Ben-Yaakov, IEEE Trans. "
          "Ind. Appl. 43 (2007) 505); 40 mm modules have some 2 ohm",
      .parameters = {Single("joule_w", "W", 10,
                            "positive warms the plate, at full drive of either sign")},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"thermal.saturation", "heater_w and cooler_w"},
      .excitation = "drive in stairs of both signs: a square, not a kink",
      .states = 0,
      .term = &term,
      .needs = {"plate_degc|imu_degc", "drive_pct"},
  };
}

}  // namespace zrobench::physics
