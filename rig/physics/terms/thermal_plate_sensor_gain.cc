#include "rig/physics/terms/thermal_plate_sensor_gain.h"

#include "rig/physics/terms/describe.h"

namespace zrobench::physics {
namespace {

constexpr std::size_t kGain = 0, kOffset = 1;

class ThermalPlateSensorGain final : public Term {
 public:
  void Show(const HeatContext&, std::span<const double> parameters, std::span<double>,
            Temperatures& shown) const override {
    shown.plate_degc += parameters[kGain] * shown.plate_degc + parameters[kOffset];
  }
};

}  // namespace

TermInfo ThermalPlateSensorGainInfo() {
  static const ThermalPlateSensorGain term;
  return {
      .id = "thermal.plate_sensor_gain",
      .sentence =
          "The plate's sensor reads in a scale of its own: its error grows with the temperature.",
      .equation = "y = (1 + gain) T_p + offset_k",
      .source = "IEC 60751, class B: +-(0.3 + 0.005 |T|) K",
      .parameters = {Single("gain", "1", 0.01, "positive reads too much when warm"),
                     Single("offset_k", "K", 0.3, "positive reads too high")},
      .borrows = {},
      .channels = {"plate_degc"},
      .lookalikes = {"contact conductance", "thermal.contact_resistance_temperature"},
      .excitation = "all at one temperature, cold and warm, long enough to settle",
      .states = 0,
      .term = &term,
      .needs = {"plate_degc", "imu_degc"},
  };
}

}  // namespace zrobench::physics
