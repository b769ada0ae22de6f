#include "tests/blind/bench.h"

namespace zrobench::blind {
namespace {

BaseModel DrawNominal(Draw& draw) {
  BaseModel model;
  model.ambient_degc = std::round(draw.Uniform(200, 250)) / 10;
  for (auto& axis : model.zro_dps) {
    axis = {draw.Uniform(-1.5, 1.5), draw.Sign() * draw.Uniform(0.008, 0.03), draw.Normal(3e-4),
            draw.Normal(5e-6)};
  }
  return model;
}

BaseModel Scatter(const BaseModel& nominal, Draw& draw) {
  const auto about = [&draw](double value) { return value * draw.Uniform(0.7, 1.3); };
  BaseModel actual = nominal;
  actual.ambient_degc += draw.Uniform(-1, 1);
  for (double* value :
       {&actual.plate_j_per_k, &actual.heater_w, &actual.cooler_w, &actual.plate_to_ambient_w_per_k,
        &actual.board_j_per_k, &actual.board_to_plate_w_per_k, &actual.board_to_ambient_w_per_k,
        &actual.package_s}) {
    *value = about(*value);
  }
  for (auto& axis : actual.zro_dps) {
    for (double& value : axis) value = about(value);
  }
  // A resonance is known from a sweep, far better than a heat capacity.
  for (double& hz : actual.resonance_hz) hz *= 1 + draw.Uniform(-3e-4, 3e-4);
  actual.resonance_q = about(actual.resonance_q);
  for (double& gain : actual.rectification_dps_per_pa2) gain = about(gain);
  return actual;
}

Instruments DrawInstruments(Draw& draw) {
  Instruments instruments;
  const auto about = [&draw](double& value) { value *= draw.Uniform(0.8, 1.25); };
  about(instruments.gyro_density_dps_per_rthz);
  about(instruments.flicker_dps);
  about(instruments.plate_noise_k);
  about(instruments.draft_k);
  about(instruments.controller_pct_per_k);
  about(instruments.controller_pct_per_k_s);
  instruments.controller_period_s = 1 + draw.Below(2);
  if (draw.Uniform(0, 1) < 0.3) {  // the coarse kind of die sensor
    instruments.die_step_k = 0.125;
    instruments.die_noise_k = 0.07;
  }
  return instruments;
}

}  // namespace

Bench DrawBench(Draw draw, bool knows_rectification) {
  Bench bench;
  bench.knows_rectification = knows_rectification;
  bench.nominal = DrawNominal(draw);
  if (knows_rectification) bench.nominal.rectification_dps_per_pa2 = {0.03, 0.04, 0.075};
  bench.actual = Scatter(bench.nominal, draw);
  bench.instruments = DrawInstruments(draw);
  bench.solids.plate_nodes = 16 + draw.Below(16);
  bench.solids.board_nodes = 6 + draw.Below(6);
  bench.solids.convection_w = draw.Uniform(0.005, 0.02);
  bench.solids.radiation_m2 = draw.Uniform(1e-5, 5e-5);
  return bench;
}

Solids Lumps() { return {.plate_nodes = 1, .board_nodes = 1}; }

}  // namespace zrobench::blind
