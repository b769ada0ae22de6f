#pragma once
// A profile: what the bench does and what is expected of the corrector (TOML, docs/formats.md).
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/result.h"
#include "rig/station/station.h"

namespace zrobench {

struct Soak {
  double to_degc = 0, hold_s = 0, settled_degc = 0.3;
};
struct Ramp {
  double to_degc = 0, rate_degc_per_min = 0;
};
struct Hold {
  double for_s = 0;
};
struct Tone {
  double hz = 0, v = 0, spl_db = 0, for_s = 0;
};  ///< v rms; spl_db from it (or given)
struct Move {
  std::string how;
  double for_s = 0;
};  ///< "tap", "rotate", "vibrate", "hand_held"
struct PowerCycle {
  double off_s = 0;
};
struct DateStep {
  double advance_days = 0;
};  ///< wall time jumps; only a simulated bench can
/// Noise, flat from low_hz to high_hz, in louder and softer passages; spl_db (and v, rms) is that
/// of the loud ones.
struct Music {
  double low_hz = 0, high_hz = 0, v = 0, spl_db = 0, for_s = 0;
};
/// Tones from from_hz to to_hz (up or down), one every step_hz, each for dwell_s.
struct Sweep {
  double from_hz = 0, to_hz = 0, step_hz = 0, v = 0, spl_db = 0, dwell_s = 0;
  double for_s = 0;  ///< tones() times dwell_s
  /// How many; a whole number.
  double tones() const;
  /// Frequency of the tone-th, from 0.
  double HzOf(double tone) const;
};
/// The board works that hard and warms itself.
struct Load {
  double duty_pct = 0, for_s = 0;
};
using Action = std::variant<Soak, Ramp, Hold, Tone, Move, PowerCycle, DateStep, Music, Sweep, Load>;

/// Something during a step; starts at a time in the step or when the board passes a temperature
/// (whichever is given).
struct Stimulus {
  std::variant<Tone, Move, Music, Sweep, Load> what;
  std::optional<double> at_s, at_degc;
};

struct Step {
  Action action;
  std::vector<Stimulus> with;
  int line = 0;
};

/// One expectation: a check's name and its parameters, numbers, texts or lists of numbers.
struct Expectation {
  using Value = std::variant<double, std::string, std::vector<double>>;
  std::string check;
  std::vector<std::pair<std::string, Value>> arguments;
  int line = 0;
  /// The number under `key`, or `otherwise`.
  double number(const std::string& key, double otherwise) const;
};

struct Needs {
  std::optional<double> min_degc, max_degc;  ///< plate range
  bool speaker = false, power = false;
};

struct Profile {
  std::string name, about;
  std::string text;  ///< the file as read, for the run folder
  std::filesystem::path path;
  Needs needs;
  std::vector<Step> steps;
  std::vector<Expectation> expects;
};

/// Reads and validates against the station's limits. All errors at once, as LoadStation does.
Result<Profile> LoadProfile(const std::filesystem::path& path, const Station& station);

}  // namespace zrobench
