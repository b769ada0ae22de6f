#pragma once
// One case: a bench, what was hidden in it, and how visible that is.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/blind/project.h"
#include "tests/blind/session.h"

namespace zrobench::blind {

/// What a case is to be.
struct CaseOrder {
  std::string kind;                                  ///< class, as in README.md
  std::vector<std::pair<std::string, double>> hide;  ///< id, wanted noncentrality
  double flicker_factor = 1;                         ///< beyond what the station file says
  double draft_factor = 1;
  bool foreign_nominals = false;  ///< nominal values far outside 30 %
};

/// What was hidden, as it came out.
struct Hidden {
  Effect effect;
  double lambda = 0;         ///< projected off the nuisances
  Yardstick::Alike nearest;  ///< for the case's first effect; else empty
};

struct HiddenCase {
  CaseOrder order;
  Bench bench;
  std::vector<Schedule> schedules;
  Paths paths;  ///< what happened
  std::vector<Hidden> hidden;
  std::vector<Effect> structural;     ///< too small to be named, in every case
  double structural_lambda = 0;       ///< of them, of the solids' finite size, convection and T^4
  double joint_lambda = 0;            ///< of everything in `hidden` at once
  double cosine = 0;                  ///< of two hidden effects, projected
  std::vector<std::string> channels;  ///< columns that carry a fifth of joint_lambda or more
  /// Per run: where 300 s carry a noncentrality above 1 in some channel [s].
  std::vector<std::vector<std::pair<int, int>>> intervals_s;
};

/// Deterministic in `order` and `seed`.
HiddenCase MakeCase(const CaseOrder& order, std::uint64_t seed);

/// Text of run `run` (from 0).
std::string RunText(const HiddenCase& made, std::size_t run, std::uint64_t seed);

}  // namespace zrobench::blind
