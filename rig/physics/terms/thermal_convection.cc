#include "rig/physics/terms/thermal_convection.h"

#include <cmath>

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kWPerK = 0, kExponent = 1;
constexpr double kSpanK = 20;

class ThermalConvection final : public Term {
 public:
  void Heat(const HeatContext& context, std::span<const double> parameters, std::span<double>,
            HeatFlows& flows) const override {
    const double above_k = context.temperatures.plate_degc - context.model.ambient_degc;
    const double beyond_linear = std::pow(std::fabs(above_k) / kSpanK, parameters[kExponent]) - 1;
    flows.plate_w -= parameters[kWPerK] * above_k * beyond_linear;
  }
};

}  // namespace

TermInfo ThermalConvectionInfo() {
  static const ThermalConvection term;
  return {
      .id = "thermal.convection",
      .sentence =
          "Air carries heat off the better the warmer the plate: the loss grows faster than the "
          "difference, alike above and below ambient.",
      .equation =
          "C_p T_p' -= w_per_k dT (|dT / 20|^exponent - 1), dT = T_p - T_a: what the linear loss "
          "lacks",
      .source =
          "natural convection: exponent 1/4 laminar, 1/3 turbulent; h 5 to 10 W/(m^2 K) in still "
          "air (engineering estimate)",
      .parameters = {Single("w_per_k", "W/K", 0.1, "positive: convection; its conductance at 20 K"),
                     Width("exponent", "1", 0.25, "growth of the conductance", {0.25, 1 / 3.0})},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"thermal.radiation", "conductance to ambient"},
      .excitation = "plateaus at several distances on both sides of ambient; fan on and off",
      .states = 0,
      .term = &term,
      .needs = {"plate_degc", "drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
