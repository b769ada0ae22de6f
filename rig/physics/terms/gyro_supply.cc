#include "rig/physics/terms/gyro_supply.h"

#include "rig/physics/terms/describe.h"
#include "rig/physics/terms/per_axis_term.h"

namespace zrobench::physics {
namespace {

constexpr double kNominalV = 3.3;

class GyroSupply final : public PerAxisTerm {
 protected:
  double Cause(const TermContext& context, std::span<const double>,
               std::span<const double>) const override {
    return context.inputs.supply_v - kNominalV;
  }
};

}  // namespace

TermInfo GyroSupplyInfo() {
  static const GyroSupply term;
  return {
      .id = "gyro.supply",
      .sentence = "The offset moves with the supply voltage, at once.",
      .equation = "y = dps_per_v (V - 3.3)",
      .source =
          "ADXRS645 data sheet (ratiometric output); magnitudes: engineering estimate, 1 to 50 "
          "mdps/V for digital parts",
      .parameters = {PerAxis("dps_per_v", "dps/V", 0.01,
                             "positive: the rate grows with the voltage")},
      .borrows = {},
      .channels = GyroChannels(),
      .lookalikes = {"thermal.self_heating"},
      .excitation = "steps of the supply at an even temperature",
      .states = 0,
      .term = &term,
      .needs = {"supply_v", "gyro_x_dps|gyro_y_dps|gyro_z_dps"},
  };
}

}  // namespace zrobench::physics
