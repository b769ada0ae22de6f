#include "rig/physics/terms/gyro_ageing.h"

#include <cmath>

namespace zrobench::physics {
namespace {

constexpr std::size_t kDpsPerDecade = 0, kDpsPerYear = 3, kOnsetDays = 6;
constexpr double kDaysPerYear = 365.25;

class GyroAgeing final : public Term {
 public:
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double>, Sensed& sensed) const override {
    const double age_days = context.inputs.age_days;
    if (age_days == 0) return;
    // Most parts are modelled without it, and a logarithm a sample is dear.
    const bool settles = parameters[kDpsPerDecade] != 0 || parameters[kDpsPerDecade + 1] != 0 ||
                         parameters[kDpsPerDecade + 2] != 0;
    const double decades = settles ? std::log10(1 + age_days / parameters[kOnsetDays]) : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sensed.rate_dps[axis] += parameters[kDpsPerDecade + axis] * decades +
                               parameters[kDpsPerYear + axis] * age_days / kDaysPerYear;
    }
  }
};

}  // namespace

TermInfo GyroAgeingInfo() {
  static const GyroAgeing term;
  return {
      .id = "gyro.ageing",
      .sentence = "The offset moves over days and months, alike at every temperature.",
      .equation = "y = dps_per_decade log10(1 + t / onset) + dps_per_year t, t the age of the part",
      .source = "form: logarithmic ageing plus a linear drift; magnitudes: engineering estimate",
      .parameters =
          {{"dps_per_decade",
            "dps",
            {0.002, 0.002, 0.002},
            0.002,
            true,
            false,
            "positive moves the rate up with each decade of age"},
           {"dps_per_year", "dps/year", {0, 0, 0}, 0.01, true, false, "positive moves the rate up"},
           {"onset_days",
            "d",
            {1},
            1,
            false,
            true,
            "age at which the decades begin",
            {0.001, 0.01, 0.1, 1, 10}}},
      .borrows = {},
      .channels = {"gyro_x_dps", "gyro_y_dps", "gyro_z_dps"},
      .lookalikes = {"gyro.warm_up", "gyro.step", "thermal.ambient_drift", "constant of the cubic"},
      .excitation = "the same temperatures again, days apart",
      .states = 0,
      .term = &term,
      .needs = {"gyro_x_dps|gyro_y_dps|gyro_z_dps"},
      .needs_power_ons = true,
  };
}

}  // namespace zrobench::physics
