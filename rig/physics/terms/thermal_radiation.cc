#include "rig/physics/terms/thermal_radiation.h"

#include <cmath>

#include "core/units.h"
#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr double kStefanBoltzmann = 5.670374419e-8;  // W/(m^2 K^4), CODATA 2018

class ThermalRadiation final : public Term {
 public:
  void Heat(const HeatContext& context, std::span<const double> parameters, std::span<double>,
            HeatFlows& flows) const override {
    const auto fourth = [](double degc) { return std::pow(degc + kKelvinOffset, 4); };
    const double exitance = kStefanBoltzmann * (fourth(context.temperatures.plate_degc) -
                                                fourth(context.model.ambient_degc));
    flows.plate_w -= parameters[0] * exitance;
  }
};

}  // namespace

TermInfo ThermalRadiationInfo() {
  static const ThermalRadiation term;
  return {
      .id = "thermal.radiation",
      .sentence =
          "The plate radiates: far above ambient it loses more heat, far below it gains less, than "
          "in proportion.",
      .equation =
          "C_p T_p' -= emissive_m2 sigma (T_p^4 - T_a^4), in kelvin; emissive_m2 = emissivity x "
          "area",
      .source = "Stefan-Boltzmann law; emissivity: bare aluminium 0.05 to 0.1, black or FR4 0.9",
      .parameters = {Single("emissive_m2", "m^2", 0.01,
                            "positive: heat leaves what is warmer than ambient")},
      .borrows = {},
      .channels = AllChannels(),
      .lookalikes = {"thermal.convection", "thermal.contact_resistance_temperature",
                     "conductance to ambient"},
      .excitation = "plateaus more than 60 K apart, above and below ambient",
      .states = 0,
      .term = &term,
      .needs = {"plate_degc", "drive_pct"},
      .linear = false,
  };
}

}  // namespace zrobench::physics
