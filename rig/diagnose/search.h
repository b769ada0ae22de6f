#pragma once
// From a fitted base model to the effects that are missing from it: scan, refit, compare, repeat.
#include <functional>
#include <string_view>
#include <vector>

#include "rig/diagnose/fit.h"
#include "rig/diagnose/scan.h"

namespace zrobench::diagnose {

/// One effect tried in a joint refit with every other parameter.
struct Trial {
  Effect effect;
  Fitted fit;
  double gain = 0;      ///< of -2 log likelihood over the model without it
  double evidence = 0;  ///< -2 log of the chance of that gain without the effect
};

struct SearchResult {
  Fitted base;                    ///< nothing but the base model
  Fitted best;                    ///< with the accepted effects
  std::vector<Trial> accepted;    ///< in the order of acceptance
  std::vector<Trial> rivals;      ///< for the first place: the others refitted, most evidence first
  std::vector<Score> first_scan;  ///< every term about the base model
  std::vector<const physics::TermInfo*> silent;
  double threshold = 0;  ///< of the first scan
  /// Effects that the station knows: in every hypothesis they stand in front.
  std::size_t known() const { return base.hypothesis.effects.size(); }
  bool ambiguous = false;  ///< a rival for an accepted effect is as good as it
};

/// Rivals this close in evidence cannot be told apart.
inline constexpr double kAmbiguous = 6;
/// A name is given where nothing is missing in at most this share of recordings.
inline constexpr double kAlpha = 0.002;
inline constexpr std::size_t kMostEffects = 3;

using Progress = std::function<void(std::string_view)>;

/// `candidates`: all shapes of all testable terms.
SearchResult Search(const Problem& problem, const Filters& filters, const Fitted& base,
                    const std::vector<Effect>& candidates, const Progress& progress);

}  // namespace zrobench::diagnose
