#pragma once
// Score test of every catalogue term, projected off what the fitted parameters can absorb.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "rig/diagnose/fit.h"

namespace zrobench::diagnose {

/// A term's best shape, from the score at zero (Rao 1948) after projection off the fit's columns
/// (Frisch and Waugh 1933). Residuals regressed on raw features would be shrunk by the share that
/// the nuisance parameters have absorbed, and name the wrong term.
struct Score {
  Effect effect;
  /// Size at which each coefficient would show with five sigma (lambda = 25), in typical
  /// magnitudes; infinite where nothing would.
  std::vector<double> limit;
  double gain = 0;      ///< chi-square of the coefficients together
  double evidence = 0;  ///< -2 log of the chance of that gain without the effect
};

/// Columns of all candidates with their projections.
class Scan {
 public:
  /// `candidates` as Shapes() gives them; terms that cannot move the predictions are dropped.
  Scan(const Problem& problem, const Filters& filters, const Fitted& about,
       const std::vector<Effect>& candidates);

  /// A term each, the best of its shapes; most evidence first.
  const std::vector<Score>& scores() const { return scores_; }
  /// Terms without any column that survives the projection.
  const std::vector<const physics::TermInfo*>& silent() const { return silent_; }
  /// The evidence that the best of all terms reaches in a share `alpha` of recordings like this one
  /// in which nothing is missing, by drawing scores from their joint distribution (parametric
  /// bootstrap of the linearised null).
  double Threshold(double alpha, std::uint64_t seed) const;

 private:
  struct Block {
    Effect effect;
    Eigen::Index first, count;
    std::vector<std::size_t> coefficients;  ///< that the columns belong to; silent ones have none
  };
  Score Judge(const Block& block, const Eigen::VectorXd& score) const;

  std::vector<Block> blocks_;
  Eigen::MatrixXd information_;  ///< of all candidates' columns, projected
  std::vector<Score> scores_;
  std::vector<const physics::TermInfo*> silent_;
};

}  // namespace zrobench::diagnose
