#pragma once
// What simpler methods answer on the same cases.
#include <string>
#include <vector>

#include "tests/blind/project.h"
#include "tests/blind/recording.h"

namespace zrobench::blind {

/// Ids named by a method; empty where it names nothing, and so detects nothing.
using Named = std::vector<std::string>;

/// A recording with its base fit; every method begins from it.
struct BaseFit {
  const Recording& recording;
  const Yardstick& yard;      ///< linearised at the fitted values
  Eigen::VectorXd residual;   ///< stacked, recording minus fitted simulation
  Eigen::VectorXd remainder;  ///< the same whitened and projected
};

/// The base model fitted to a recording, linearised anew at every step: nominal values are far off.
BaseModel FittedModel(const Recording& recording);

/// Ranks every effect's raw signature by its correlation with the raw residual, each channel in
/// units of its own scatter; names the best above Bonferroni's 1 % for white noise.
Named ByCorrelation(const BaseFit& fit);
/// Sequentially thresholded least squares of the gyro's residual on algebraic columns of what was
/// measured (T, its rate, supply, tone, acceleration), threshold 1 mdps of typical contribution
/// (Brunton 2016); it has no memory, delay or heat flow to name.
Named ByStlsq(const BaseFit& fit);
/// Likelihood ratio of each effect in turn, noise as the station states it, chi-square table at
/// 1 % over all candidates.
Named ByLikelihoodRatio(const BaseFit& fit);
/// Knows what to look for: names the truth where its own likelihood ratio is significant at 1 %.
Named Oracle(const BaseFit& fit, const std::vector<std::string>& truth);
/// Share of the gyro's error in the last run that ridge regression on (T, dT/dt, t), trained on
/// the others, leaves [0 ... 1 and more].
double RidgeHeldOutShare(const BaseFit& fit);

}  // namespace zrobench::blind
