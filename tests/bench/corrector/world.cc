#include "tests/bench/corrector/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zrobench::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGyroNoiseDps = 0.05;
constexpr double kAccelNoiseG = 0.02 / 9.80665;
constexpr double kTempNoiseDegc = 0.02;
constexpr double kFlickerDps = 0.0007;
constexpr double kFactoryErrorDps = 0.010;

}  // namespace

Vector OffsetAt(double temp_degc) {
  const double d = temp_degc - 25.0;
  return {0.8 + 0.030 * d - 4e-4 * d * d + 1e-5 * d * d * d, -1.1 - 0.022 * d + 5e-4 * d * d,
          0.35 + 0.012 * d + 2e-4 * d * d - 6e-6 * d * d * d};
}

World::World(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      rng_(seed * 7919 + 17),
      noise_factor_(std::sqrt(scenario.sample_hz / 100.0)) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * kPi);
  for (double& phase : phases_) phase = angle(rng_);
  for (double& state : flicker_) state = kFlickerDps * Normal();
  play_degc_ = lagged_degc_ = TemperatureAt(0.0);
}

double World::TemperatureAt(double t_s) const {
  if (scenario_.ramp_degc_per_s != 0.0) return 22.0 + scenario_.ramp_degc_per_s * t_s;
  return scenario_.mean_degc +
         scenario_.swing_degc * std::sin(2.0 * kPi * t_s / scenario_.period_s - kPi / 2.0);
}

Vector World::CurveAt(double temp_degc, double t_s) const {
  Vector offset = OffsetAt(temp_degc);
  if (t_s < scenario_.step_at_s) return offset;
  for (std::size_t i = 0; i < 3; ++i) offset[i] += scenario_.step_dps[i];
  return offset;
}

Vector World::TruthAt(double t_s, double temp_degc) {
  double common = 0.0;
  if (scenario_.play_half_degc > 0.0) {
    const double w = scenario_.play_half_degc;
    play_degc_ = std::clamp(play_degc_, temp_degc - w, temp_degc + w);
    common += 0.010 * (temp_degc - play_degc_) / 2.0;
  }
  if (scenario_.flicker) {
    double tau_s = 4.0;
    for (double& state : flicker_) {
      const double keep = std::exp(-1.0 / (scenario_.sample_hz * tau_s));
      state = keep * state + kFlickerDps * std::sqrt(1.0 - keep * keep) * Normal();
      common += state;
      tau_s *= 3.0;
    }
  }
  common += scenario_.rate_dps_s_per_degc * (TemperatureAt(t_s + 0.5) - TemperatureAt(t_s - 0.5));
  Vector truth = CurveAt(temp_degc, t_s);
  for (double& axis : truth) axis += common;
  return truth;
}

const Disturbance* World::DisturbanceAt(int period, bool still) const {
  if (!still) return nullptr;
  for (const Disturbance& d : scenario_.disturbances) {
    if (period < d.begin || period < d.from_minute || period >= d.to_minute) continue;
    if ((period - d.begin) % d.every < d.length) return &d;
  }
  return nullptr;
}

void World::Move(double t_in_motion_s, double t_s, zro::Sample* sample) const {
  constexpr double kTurnHz[3] = {0.3, 0.5, 0.7};
  constexpr double kShakeHz[3] = {0.7, 1.0, 1.3};
  const double fade = std::min({1.0, t_in_motion_s, scenario_.motion_s - t_in_motion_s});
  for (std::size_t i = 0; i < 3; ++i) {
    sample->rate_dps[i] +=
        static_cast<float>(fade * 60.0 * std::sin(2.0 * kPi * kTurnHz[i] * t_s + phases_[i]));
    sample->accel_g[i] += static_cast<float>(
        fade * 1.5 / 9.80665 * std::sin(2.0 * kPi * kShakeHz[i] * t_s + phases_[i + 3]));
  }
}

double World::Shown(double temp_degc, double t_s) {
  double shown = temp_degc;
  if (scenario_.lag_s > 0.0) {
    lagged_degc_ += (temp_degc - lagged_degc_) / (scenario_.lag_s * scenario_.sample_hz);
    shown = lagged_degc_;
  }
  shown += kTempNoiseDegc * Normal();
  if (scenario_.temp_step_degc > 0.0) {
    shown = scenario_.temp_step_degc * std::round(shown / scenario_.temp_step_degc);
  }
  if (scenario_.fault != Fault::kTemperatureStuck || t_s < 1800.0) shown_degc_ = shown;
  return shown_degc_;
}

void World::Spoil(Instant* instant) {
  zro::Sample& s = instant->sample;
  const bool one_in_1000 = n_ % 1000 == 371;
  switch (scenario_.fault) {
    case Fault::kGyroSaturates:
      s.gyro_clipped = std::fmod(instant->t_s, 2.0) < 0.05;
      if (s.gyro_clipped) s.rate_dps[0] = 2000.0f;
      break;
    case Fault::kGyroStuck:
      if (instant->still && instant->t_s >= 1800.0 && instant->t_s < 2700.0) {
        for (std::size_t i = 0; i < 3; ++i) s.rate_dps[i] = stuck_.rate_dps[i];
      } else {
        stuck_ = s;
      }
      break;
    case Fault::kNan:
      if (one_in_1000) s.rate_dps[1] = std::nanf("");
      break;
    case Fault::kDropped:
      instant->comes = !one_in_1000;
      break;
    case Fault::kRepeated:  // it fills the place of the one that should have come
      if (one_in_1000) s = previous_;
      break;
    default:
      break;
  }
  previous_ = s;
  s.elapsed = 1 + lost_;
  lost_ = instant->comes ? 0 : lost_ + 1;
}

bool World::Next(Instant* out) {
  const double t = static_cast<double>(n_) / scenario_.sample_hz;
  if (t >= scenario_.duration_s) return false;
  const double cycle_s = scenario_.still_s + scenario_.motion_s;
  const int period = static_cast<int>(t / cycle_s + 1e-9);
  const double within_s = t - period * cycle_s;
  *out = {};
  out->t_s = t;
  out->period = period;
  out->still = within_s < scenario_.still_s - 1e-9;
  out->comes = true;
  out->temp_degc = TemperatureAt(t);
  out->truth_dps = TruthAt(t, out->temp_degc);
  const Disturbance* extra = DisturbanceAt(period, out->still);
  out->disturbed = extra != nullptr;
  const double noise = noise_factor_ * (extra != nullptr ? extra->noise_factor : 1.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const double rate = out->truth_dps[i] + (extra != nullptr ? extra->extra_dps[i] : 0.0);
    out->sample.rate_dps[i] = static_cast<float>(rate + noise * kGyroNoiseDps * Normal());
    const double gravity = i == 2 ? 1.0 : 0.0;
    out->sample.accel_g[i] = static_cast<float>(gravity + kAccelNoiseG * Normal());
  }
  if (!out->still) Move(within_s - scenario_.still_s, t, &out->sample);
  out->sample.temp_degc = static_cast<float>(Shown(out->temp_degc, t));
  Spoil(out);
  ++n_;
  return true;
}

std::vector<std::pair<double, Vector>> FactoryOf(const Scenario& scenario, std::uint64_t seed) {
  std::mt19937_64 rng(seed * 104729 + 5);
  std::normal_distribution<double> error(0.0, kFactoryErrorDps);
  std::vector<std::pair<double, Vector>> entries;
  for (const double degc : scenario.factory_degc) {
    Vector zro = OffsetAt(degc);
    for (double& axis : zro) axis += error(rng);
    entries.emplace_back(degc, zro);
  }
  return entries;
}

}  // namespace zrobench::bench
