#include "rig/physics/terms/thermal_ambient_drift.h"

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr double kHour_s = 3600;

/// State: time since the beginning [s]. It goes on over a power-on.
class ThermalAmbientDrift final : public Term {
 public:
  void Place(const Temperatures&, std::span<double> states) const override { states[0] = 0; }
  void Heat(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, HeatFlows& flows) const override {
    const double warmer_k = parameters[0] * (states[0] + context.dt_s / 2) / kHour_s;
    states[0] += context.dt_s;
    flows.plate_w += context.model.plate.to_ambient_w_per_k * warmer_k;
    if (context.model.board) {
      flows.board_w += context.model.board->to_ambient_w_per_k * warmer_k;
    }
  }
};

}  // namespace

TermInfo ThermalAmbientDriftInfo() {
  static const ThermalAmbientDrift term;
  return {
      .id = "thermal.ambient_drift",
      .sentence =
          "The room grows warmer or colder during the run, and all temperatures follow slowly.",
      .equation = "T_a(t) = T_a + k_per_h t / 3600, in both losses to ambient",
      .source = "rooms drift 0.2 to 3 K/h (engineering estimate)",
      .parameters = {Single("k_per_h", "K/h", 0.5, "positive: the room warms")},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"thermal.self_heating", "gyro.ageing", "thermal.parallel_mass"},
      .excitation = "long soaks with little drive; a sensor in the room",
      .states = 1,
      .term = &term,
      .needs = {"plate_degc|imu_degc", "drive_pct"},
  };
}

}  // namespace zrobench::physics
