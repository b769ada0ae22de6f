#include "rig/physics/terms/thermal_saturation.h"

#include <algorithm>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

class ThermalSaturation final : public Term {
 public:
  double Drive(const HeatContext&, std::span<const double> parameters, std::span<double>,
               double drive_pct) const override {
    const double limit_pct = std::max(0.0, 100 - parameters[0]);
    return std::clamp(drive_pct, -limit_pct, limit_pct);
  }
};

}  // namespace

TermInfo ThermalSaturationInfo() {
  static const ThermalSaturation term;
  return {
      .id = "thermal.saturation",
      .sentence = "The actuator stops growing before its command does.",
      .equation = "Q(drive) -> Q(clamp(drive, -(100 - missing_pct), 100 - missing_pct))",
      .source = "current limits and supplies that sag (engineering estimate)",
      .parameters = {Amount("missing_pct", "%", 20,
                            "how far below 100 % of drive it ends; 0 = none",
                            {5, 10, 20, 30, 40, 60})},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"thermal.peltier_joule", "heater_w and cooler_w"},
      .excitation = "drive in stairs up to both limits",
      .states = 0,
      .term = &term,
      .needs = {"plate_degc|imu_degc", "drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
