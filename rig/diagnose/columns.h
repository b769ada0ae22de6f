#pragma once
// Whitened sensitivities of the predictions to an effect's coefficients, in typical magnitudes.
#include <Eigen/Core>
#include <vector>

#include "rig/diagnose/fit.h"

namespace zrobench::diagnose {

/// Of an effect on the rates, along the die's temperature as it stands in `at`; `model` holds what
/// the effect borrows.
std::vector<Eigen::VectorXd> RateColumnsOf(const Effect& effect, const Problem& problem,
                                           const physics::Model& model, const Filters& filters,
                                           const Evaluated& at);

/// Of any effect, at coefficients of zero beside a fit without it.
std::vector<Eigen::VectorXd> ColumnsOf(const Effect& effect, const Problem& problem,
                                       const Filters& filters, const Fitted& about);

}  // namespace zrobench::diagnose
