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
using Action = std::variant<Soak, Ramp, Hold, Tone, Move, PowerCycle, DateStep>;

/// A tone or a move during a step; starts at a time in the step or when the board passes a
/// temperature (whichever is given).
struct Stimulus {
  std::variant<Tone, Move> what;
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
