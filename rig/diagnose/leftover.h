#pragma once
#include "rig/diagnose/fit.h"
#include "rig/diagnose/problem.h"

namespace zrobench::diagnose {

/// Whether the innovations still depend on anything, known or not: a fixed dictionary (bumps over
/// temperature and time, the temperature's rate and its sign, sound, supply) projected off the fit.
struct Leftover {
  bool significant = false;
  double log_p = 0;            ///< of the dictionary's chi-square after the accepted effects
  double explained_share = 1;  ///< of what the dictionary saw before them
  Eigen::VectorXd fitted;      ///< whitened, stacked: what the dictionary explains of the rest
};
Leftover JudgeLeftover(const Problem& problem, const Filters& filters, const Fitted& base,
                       const Fitted& best);

}  // namespace zrobench::diagnose
