#include "rig/physics/terms/thermal_contact_resistance_temperature.h"

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr double kReferenceDegc = 25, kSpanK = 40;

class ThermalContactResistanceTemperature final : public Term {
 public:
  void Heat(const HeatContext& context, std::span<const double> parameters, std::span<double>,
            HeatFlows& flows) const override {
    if (!context.model.board) return;
    const Temperatures& t = context.temperatures;
    const double better = parameters[0] * (t.board_degc - kReferenceDegc) / kSpanK;
    const double more_w =
        better * context.model.board->to_plate_w_per_k * (t.plate_degc - t.board_degc);
    flows.board_w += more_w;
    flows.plate_w -= more_w;
  }
};

}  // namespace

TermInfo ThermalContactResistanceTemperatureInfo() {
  static const ThermalContactResistanceTemperature term;
  return {
      .id = "thermal.contact_resistance_temperature",
      .sentence =
          "The contact between plate and board gets better or worse as it warms: grease, warpage, "
          "bolts.",
      .equation = "G_pb -> G_pb (1 + per_40k (T_b - 25) / 40)",
      .source = "thermal interface practice; magnitudes: engineering estimate, 0 to 0.3 per 40 K",
      .parameters = {Single("per_40k", "1/40K", 0.1, "positive: better contact when warm")},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"thermal.radiation", "thermal.convection", "contact conductance"},
      .excitation = "fast cycles about a cold and about a warm temperature",
      .states = 0,
      .term = &term,
      .needs = {"imu_degc", "plate_degc|drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
