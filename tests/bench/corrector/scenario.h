#pragma once
// What the world does to a gyro in a benchmark scenario, as plain figures. Beside the learned
// scenarios (cycle ... ramp), the conditions that a product meets and a benchmark usually leaves
// out.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace zrobench::bench {

/// Rotation or sound in the stills whose minute fits: begin, begin + every, ... for `length` each,
/// of those that start in [from_minute, to_minute).
struct Disturbance {
  int begin = 0, every = 1, length = 1;
  int from_minute = 0, to_minute = 1 << 20;
  double extra_dps[3] = {0, 0, 0};
  double noise_factor = 1.0;
};

/// Faults of the sensors or of the link.
enum class Fault {
  kNone,
  kGyroSaturates,     ///< full scale, flagged, for 50 ms of every 2 s
  kTemperatureStuck,  ///< from 1800 s on
  kGyroStuck,         ///< repeats one value in the stills of [1800, 2700) s
  kNan,               ///< one sample in 1000 is no number
  kDropped,           ///< one sample in 1000 never comes
  kRepeated,          ///< one sample in 1000 comes twice
};

/// 100 Hz unless told. Temperature: mean + swing * sin(2 pi t / period - pi/2), or a ramp.
/// Each minute begins with a still of still_s, then motion to the minute's end.
struct Scenario {
  std::string name;
  std::string about;
  double duration_s = 7200.0;
  double score_from_s = 300.0;
  double score_max_from_s = 0.0;  ///< the greatest error counts from here (0: score_from_s)
  double sample_hz = 100.0;
  double mean_degc = 30.0, swing_degc = 12.0, period_s = 3600.0;
  double ramp_degc_per_s = 0.0;  ///< not 0: 22 degC + this * t instead
  double still_s = 20.0, motion_s = 40.0;
  double temp_step_degc = 0.0;       ///< the sensor's resolution, 0: fine
  double lag_s = 0.0;                ///< the sensor shows the gyro's temperature this much behind
  double play_half_degc = 0.0;       ///< offset += 10 mdps * (T - play) / 2 degC
  double rate_dps_s_per_degc = 0.0;  ///< offset += this * dT/dt
  bool flicker = false;
  double step_dps[3] = {0, 0, 0};  ///< added to the truth from step_at_s
  double step_at_s = 0.0;
  std::vector<Disturbance> disturbances;
  Fault fault = Fault::kNone;
  std::vector<double> factory_degc = {20.0, 25.0, 30.0};
  std::optional<int> date = 15000;    ///< days since 1984-01-01 told at the start
  std::optional<double> reboot_at_s;  ///< orderly: commits first
  std::optional<double> cut_at_s;
  std::optional<double> date_at_s;  ///< the date goes back by a year here
  /// Figures to hold, mdps; 0: measured only.
  double target_rms_mdps = 0.0, target_max_mdps = 0.0;
};

/// All of them, in the order of the table.
const std::vector<Scenario>& Scenarios();
/// By name; throws when there is none.
const Scenario& FindScenario(const std::string& name);

}  // namespace zrobench::bench
