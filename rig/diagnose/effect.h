#pragma once
// Catalogue terms as the diagnosis handles them: what they would change in the predictions.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "rig/diagnose/problem.h"
#include "rig/physics/term.h"

namespace zrobench::diagnose {

/// A term with its shape parameters chosen; its coefficients are what a fit finds.
struct Effect {
  const physics::TermInfo* info = nullptr;
  std::vector<double> shape;  ///< of the shape parameters, in the catalogue's order
};

/// One number that a fit finds, in units of its typical magnitude.
struct Coefficient {
  std::string parameter;
  int axis = -1;  ///< -1: one value for all
  double typical = 1;
  std::string unit;
};
std::vector<Coefficient> CoefficientsOf(const physics::TermInfo& info);

/// Moves temperatures (drive, heat, sensors), and is simulated with the thermal model; else it adds
/// to the rates along the die's temperature, linearly in its coefficients.
bool IsThermal(const physics::TermInfo& info);

/// All combinations of the shape parameters' grids; one empty combination where there are none.
std::vector<Effect> Shapes(const physics::TermInfo& info);

/// The flat parameters (physics::FlatParameters) with these coefficients, in typical magnitudes.
/// Borrowed parameters are the model's.
std::vector<double> ParametersOf(const Effect& effect, const std::vector<double>& coefficients,
                                 const physics::Model& model);

/// What a thermal effect with coefficients zero adds to a point: the knobs move it from there.
void Install(const Effect& effect, Point& point);
std::vector<Knob> EffectKnobs(const Effect& effect);

/// Rates that an effect on the rates adds: for each coefficient, (run) block means [dps] at its
/// typical magnitude; only on the coefficient's axis, or on all three one after the other.
struct RateResponse {
  std::vector<std::array<Eigen::ArrayXd, 3>> rates;  ///< a run each; zero-sized where untouched
};
/// `model` holds the parameters that the effect borrows.
std::vector<RateResponse> RateResponses(const Effect& effect, const Problem& problem,
                                        const physics::Model& model, const Evaluated& at);

/// The terms that the station's own simulation knows and that a fit can scale: part of the base
/// model, their coefficients fitted like every nominal value.
std::vector<Effect> KnownEffects(const Problem& problem);

}  // namespace zrobench::diagnose
