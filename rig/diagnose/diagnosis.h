#pragma once
// The whole diagnosis: where simulation and recording differ, which physics was left out, how much
// better a model with it predicts, and what the recording could not have shown.
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rig/diagnose/case.h"
#include "rig/physics/term.h"

namespace zrobench::diagnose {

enum class Outcome {
  kNoMissingPhysics,
  kRecalibrate,  ///< only nominal values were off
  kNamed,
  kAmbiguitySet,  ///< several explanations in reach
  kPartlyExplained,
  kUnexplained,  ///< nothing in the catalogue explains it
  kBusFault,     ///< the data are unfit for physics
};
std::string_view OutcomeName(Outcome outcome);

struct ParameterFound {
  std::string name, unit;
  double value = 0;
  std::optional<std::pair<double, double>> ci95;  ///< none for a shape chosen from a grid
};

/// Per channel, in the channel's unit.
using PerChannel = std::map<std::string, double>;

struct TermFound {
  const physics::TermInfo* info = nullptr;
  std::vector<ParameterFound> parameters;
  double log_likelihood_gain = 0;
  double p_value = 1;  ///< of the best of all terms in recordings in which nothing is missing
};

/// rms of measured - predicted, the power-on's own constant taken off.
struct Errors {
  PerChannel before, after;                  ///< on the data of the fit
  PerChannel heldout_before, heldout_after;  ///< on runs that the fit had not seen
  PerChannel noise_floor;
};

struct Mismatch {
  bool detected = false;
  std::vector<std::string> channels;
  std::map<std::string, std::vector<std::pair<double, double>>> intervals_s;  ///< by run
  double share_of_energy = 0;  ///< of the squared innovations, that the found terms explain
};

struct Rival {
  const physics::TermInfo* info = nullptr;
  double evidence_short = 0;  ///< by how much it falls short of the best
};

/// What the first look at every term gave, before anything was added to the model.
struct Seen {
  const physics::TermInfo* info = nullptr;
  double evidence = 0;
};

struct Limit {
  const physics::TermInfo* info = nullptr;
  std::string parameter, unit;
  double smallest_visible = 0;
};

/// A nominal value that the recording contradicts.
struct Recalibration {
  std::string key;
  double nominal = 0, fitted = 0, sd = 0;
};

struct Diagnosis {
  Outcome outcome = Outcome::kNoMissingPhysics;
  std::string reason;  ///< why, where the outcome does not say it by itself
  Mismatch mismatch;
  std::vector<TermFound> terms;
  Errors errors;
  std::vector<const physics::TermInfo*> ambiguity;
  std::vector<Rival> rivals;
  std::vector<Seen> scan;     ///< most evidence first
  double leftover_log_p = 0;  ///< of what the innovations still depend on after the named terms
  std::vector<Limit> limits;
  std::vector<std::string> not_excited, not_testable;
  std::vector<Recalibration> recalibrations;
  std::vector<std::string> heldout_runs;
  double evidence = 0, threshold = 0;
  std::map<std::string, double> noise;  ///< estimated; names end in their unit
  double seconds = 0;
};

/// Blocks for seconds; `progress` is told what is being done (may be empty). Deterministic.
Diagnosis Diagnose(const Case& loaded, const std::function<void(std::string_view)>& progress);

}  // namespace zrobench::diagnose
