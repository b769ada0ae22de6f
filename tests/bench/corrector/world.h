#pragma once
// The world of a scenario, sample by sample: what the sensors show and what the offset truly is.
#include <array>
#include <cstdint>
#include <random>

#include "corrector/types.h"
#include "tests/bench/corrector/scenario.h"

namespace zrobench::bench {

using Vector = std::array<double, 3>;

/// Zero-rate offset over temperature, dps: cubics about 25 degC.
Vector OffsetAt(double temp_degc);

struct Instant {
  zro::Sample sample;
  double t_s;
  double temp_degc;  ///< the gyro's own
  Vector truth_dps;  ///< offset
  int period;        ///< still and motion make one; counts from 0
  bool still;
  bool disturbed;  ///< rotation or sound is added
  bool comes;      ///< false: lost on its way
};

/// White noise a sample at 100 Hz (the same density at other rates): gyro 50 mdps, accelerometer
/// 0.02 m/s2, temperature 0.02 degC. Same scenario and seed, same samples.
class World {
 public:
  World(const Scenario& scenario, std::uint64_t seed);

  /// The next sample; false at the scenario's end.
  bool Next(Instant* out);

  /// The curve at a temperature, the step included from its time on.
  Vector CurveAt(double temp_degc, double t_s) const;

 private:
  double TemperatureAt(double t_s) const;
  Vector TruthAt(double t_s, double temp_degc);
  const Disturbance* DisturbanceAt(int period, bool still) const;
  void Move(double t_in_motion_s, double t_s, zro::Sample* sample) const;
  double Shown(double temp_degc, double t_s);
  void Spoil(Instant* instant);
  double Normal() { return normal_(rng_); }

  Scenario scenario_;
  std::mt19937_64 rng_;
  std::normal_distribution<double> normal_;
  double noise_factor_;
  std::int64_t n_ = 0;
  std::array<double, 6> phases_;
  std::array<double, 8> flicker_{};
  double play_degc_;
  double lagged_degc_;
  double shown_degc_ = 0.0;
  zro::Sample previous_{};
  zro::Sample stuck_{};
  std::uint32_t lost_ = 0;
};

/// Factory entries of a scenario: the truth with 10 mdps rms of error, drawn with the seed.
std::vector<std::pair<double, Vector>> FactoryOf(const Scenario& scenario, std::uint64_t seed);

}  // namespace zrobench::bench
