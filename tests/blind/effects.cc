#include "tests/blind/effects.h"

#include <algorithm>
#include <stdexcept>

namespace zrobench::blind {
namespace {

using enum Stage;

std::vector<std::vector<double>> Over(std::initializer_list<double> values) {
  std::vector<std::vector<double>> grid;
  for (const double value : values) grid.push_back({value});
  return grid;
}

std::vector<std::vector<double>> StepTimes() {
  std::vector<std::vector<double>> grid;
  for (double at = 0.25; at < 4; at += 0.5) grid.push_back({at});
  return grid;
}

std::vector<Kind> Thermal() {
  return {
      {"thermal.contact_resistance_temperature", kThermal, "per_40k", "1", 0.03, 0.6, {}, {}, true},
      {"thermal.series_mass", kThermal, "time_constant_s", "s", 0.5, 40, {}, {}},
      {"thermal.parallel_mass",
       kThermal,
       "conductance_w_per_k",
       "W/K",
       3e-3,
       0.3,
       {{"time_constant_s", 150, 1200}},
       Over({150, 400, 1200})},
      {"thermal.convection", kThermal, "loss_at_40k_w", "W", 0.5, 15, {}, {}},
      {"thermal.radiation", kThermal, "emissive_area_m2", "m^2", 2e-3, 0.2, {}, {}},
      {"thermal.ambient_drift", kThermal, "k_per_h", "K/h", 0.1, 5, {}, {}, true},
      {"thermal.self_heating", kThermal, "power_w", "W", 0.02, 1, {}, {}},
      {"thermal.dead_time", kThermal, "delay_s", "s", 0.1, 10, {}, {}},
      {"thermal.saturation", kThermal, "cut_pct", "%", 30, 90, {}, {}},
      {"thermal.peltier_joule", kThermal, "joule_w", "W", 2, 40, {}, {}},
      {"thermal.plate_sensor_lag", kThermal, "time_constant_s", "s", 0.2, 20, {}, {}},
      {"thermal.plate_sensor_gain", kThermal, "gain", "1", 2e-3, 0.1, {}, {}, true},
      {"thermal.die_sensor_hold", kSampling, "hold_s", "s", 0.5, 30, {}, {}},
      {"time.clock_skew", kSampling, "ratio", "1", 3e-5, 2e-3, {}, {}, true},
      {"time.latency", kSampling, "delay_s", "s", 0.1, 8, {}, {}},
      {"time.drops", kSampling, "lost_s", "s", 0.2, 20, {{"phase", 0, 1}}, Over({0, 0.5})},
      {"time.sample_hold", kSampling, "hold_s", "s", 0.5, 30, {}, {}},
      {"bus.stale_command", kThermal, "stale_s", "s", 1, 120, {{"phase", 0, 1}}, Over({0, 0.5})},
  };
}

std::vector<Kind> Gyro() {
  return {
      {"gyro.backlash",
       kGyro,
       "dps_per_40k",
       "dps",
       0.01,
       0.5,
       {{"half_width_k", 1, 8}},
       Over({1, 2, 4, 8}),
       true},
      {"gyro.hysteresis",
       kGyro,
       "dps",
       "dps",
       0.01,
       0.5,
       {{"half_width_k", 2, 8}},
       Over({2, 4, 8}),
       true},
      {"gyro.temperature_rate", kGyro, "dps_per_k_per_s", "dps s/K", 0.02, 2, {}, {}, true},
      {"gyro.creep",
       kGyro,
       "dps_per_40k",
       "dps",
       0.01,
       0.5,
       {{"time_constant_s", 150, 2000}, {"stretch", 0.55, 0.95}},
       {{150, 1}, {400, 1}, {1000, 1}, {2500, 1}},
       true},
      {"gyro.ageing",
       kGyro,
       "dps_per_decade",
       "dps",
       0.01,
       1,
       {{"onset_h", 0.05, 1}},
       Over({0.05, 0.3, 2}),
       true},
      {"gyro.warm_up",
       kGyro,
       "dps",
       "dps",
       0.01,
       1,
       {{"time_constant_s", 60, 1200}},
       Over({60, 200, 600, 1500}),
       true},
      {"gyro.supply", kGyro, "dps_per_v", "dps/V", 0.02, 2, {}, {}, true},
      {"gyro.temperature_curve",
       kGyro,
       "dps",
       "dps",
       0.01,
       0.5,
       {{"kink_degc", 20, 45}},
       Over({0, 20, 28, 36, 44}),
       true},
      {"gyro.step", kGyro, "dps", "dps", 0.01, 0.5, {{"at_run", 0.2, 3.8}}, StepTimes(), true},
      {"gyro.g_sensitivity",
       kGyro,
       "dps_per_g",
       "dps/g",
       0.01,
       1,
       {{"azimuth_rad", 0, 6.28}},
       Over({0, 1.5708, -1}),
       true,
       true},
      {"gyro.vibration_rectification", kGyro, "dps_per_g2", "dps/g^2", 0.01, 1, {}, {}, true},
      {"acoustic.rectification", kGyro, "dps_per_pa2", "dps/Pa^2", 0.01, 1, {}, {}},
      {"acoustic.resonance_drift", kGyro, "ppm_per_k", "ppm/K", 2, 200, {}, {}, true},
      {"acoustic.harmonics", kGyro, "third_share", "1", 0.1, 1, {}, {}},
  };
}

}  // namespace

const std::vector<Kind>& KnownKinds() {
  static const std::vector<Kind> kinds = [] {
    std::vector<Kind> all = Thermal();
    for (Kind& kind : Gyro()) all.push_back(std::move(kind));
    return all;
  }();
  return kinds;
}

const std::vector<Kind>& ForeignKinds() {
  static const std::vector<Kind> kinds = {
      {"other.ripple", kGyro, "dps", "dps", 0.01, 0.5, {{"period_k", 4, 14}}, {}, true},
      {"other.rising_rate", kGyro, "dps_per_k_per_s", "dps s/K", 0.05, 5, {}, {}, true},
      {"other.tone_temperature", kGyro, "dps_per_pa2", "dps/Pa^2", 0.005, 0.5, {}, {}, true},
      {"other.supply_temperature", kGyro, "dps_per_v", "dps/V", 0.03, 3, {}, {}, true},
      {"other.telegraph", kGyro, "dps", "dps", 0.005, 0.5, {{"dwell_s", 100, 500}}, {}, true},
      {"other.fractional", kGyro, "dps_per_40k", "dps", 0.01, 0.5, {}, {}, true},
      {"other.fan", kThermal, "w_per_k", "W/K", 0.02, 1, {{"dwell_s", 300, 900}}, {}},
  };
  return kinds;
}

const Kind& KindOf(std::string_view id) {
  for (const auto* kinds : {&KnownKinds(), &ForeignKinds()}) {
    for (const Kind& kind : *kinds) {
      if (kind.id == id) return kind;
    }
  }
  throw std::out_of_range("no effect is called " + std::string(id));
}

bool IsKnown(std::string_view id) { return !id.starts_with("other."); }

bool NeedsRectification(std::string_view id) {
  return id == "acoustic.resonance_drift" || id == "acoustic.harmonics";
}

bool ExcludesRectification(std::string_view id) { return id == "acoustic.rectification"; }

bool ActsOnEachAxis(const Kind& kind) {
  return kind.stage == kGyro && !NeedsRectification(kind.id);
}

std::vector<std::vector<double>> SuspectedShapes(const Kind& kind) {
  return kind.grid.empty() ? std::vector<std::vector<double>>{{}} : kind.grid;
}

Effect DrawEffect(const Kind& kind, Draw& draw) {
  Effect effect{.id = std::string(kind.id), .strength = kind.typical, .axes = {}, .shape = {}};
  for (double& axis : effect.axes) axis = draw.Sign() * draw.Uniform(0.2, 1);
  effect.axes[static_cast<std::size_t>(draw.Below(3))] = draw.Sign();
  if (kind.stage == Stage::kGyro && !kind.signed_strength) {
    for (double& axis : effect.axes) axis = std::abs(axis);
  }
  if (kind.signed_strength) effect.strength *= draw.Sign();
  for (const ShapeRange& range : kind.shapes) {
    effect.shape.push_back(range.low > 0 ? draw.LogUniform(range.low, range.high)
                                         : draw.Uniform(range.low, range.high));
  }
  return effect;
}

const Effect* Find(const std::vector<Effect>& effects, std::string_view id) {
  const auto found = std::ranges::find(effects, id, &Effect::id);
  return found == effects.end() ? nullptr : &*found;
}

double StrengthOf(const std::vector<Effect>& effects, std::string_view id) {
  const Effect* effect = Find(effects, id);
  return effect ? effect->strength : 0;
}

double ShapeOf(const std::vector<Effect>& effects, std::string_view id, double otherwise) {
  const Effect* effect = Find(effects, id);
  return effect && !effect->shape.empty() ? effect->shape[0] : otherwise;
}

}  // namespace zrobench::blind
