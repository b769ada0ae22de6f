#pragma once
// Joint fit of the base model and of accepted effects: Gauss-Newton on whitened innovations.
#include <Eigen/Core>
#include <vector>

#include "rig/diagnose/effect.h"
#include "rig/diagnose/problem.h"

namespace zrobench::diagnose {

/// What is fitted: nothing but the base model when `effects` is empty.
struct Hypothesis {
  std::vector<Effect> effects;
};

struct Fitted {
  Hypothesis hypothesis;
  Point point;  ///< the thermal model
  Evaluated at;
  Filters::Slopes slopes_dps_per_k;
  Eigen::MatrixXd columns;    ///< whitened sensitivities: stacked rows, a parameter each
  Eigen::VectorXd precision;  ///< of each parameter's prior
  Eigen::VectorXd residual;   ///< whitened, stacked; at the optimum
  Eigen::VectorXd linear;  ///< the rates' parameters: axis by axis constants, x, x^2, x^3; effects
  double cost = 0;         ///< |residual|^2 plus the priors' share: -2 log likelihood + const

  /// Index of an effect's first column, and how many it has.
  struct Range {
    Eigen::Index first = 0, count = 0;
  };
  std::vector<Range> effect_columns;
  /// Values of an effect's coefficients, in typical magnitudes, and their standard deviations.
  std::vector<double> Coefficients(std::size_t effect) const;
  /// Curvature of the cost over all columns' parameters, priors included; its inverse is their
  /// covariance.
  Eigen::MatrixXd Information() const;
  Eigen::MatrixXd Covariance() const;
  std::vector<double> CoefficientSd(std::size_t effect) const;

  /// The base model of one axis' rates.
  struct RateParameters {
    std::vector<double> constants;  ///< a run each [dps]
    std::array<double, 3> cubic{};  ///< of x, x^2, x^3 [dps]
  };
  RateParameters RatesOf(std::size_t axis) const;
  std::size_t runs = 0;
  std::array<bool, 3> axes{};  ///< that have rates
};

/// Needs a problem with at least one measured channel. `start` is where the thermal model begins.
Fitted Fit(const Problem& problem, const Filters& filters, const Point& start,
           const Hypothesis& hypothesis);

}  // namespace zrobench::diagnose
