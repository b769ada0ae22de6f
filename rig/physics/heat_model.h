#pragma once
// Heat as the rig has it: the linear network, and the terms that a model adds to it.
#include <span>
#include <vector>

#include "rig/physics/model.h"
#include "rig/physics/rig_model.h"
#include "rig/physics/term.h"
#include "rig/physics/thermal_network.h"

namespace zrobench::physics {

/// Plate, board and die moved forward with every active term. The network is exact for heat held
/// over a step; what the terms add is held, too, at temperatures foreseen for the step's middle
/// from the step before (second order while nothing jumps). The virtual rig steps it beside its
/// sensors; diagnosis runs it over whole recordings.
class HeatModel {
 public:
  /// `model` is valid (Validate). Starts at ambient, powered on.
  explicit HeatModel(const Model& model);

  /// Everything at ambient, the terms' own masses, too.
  void Reset();
  /// Start of a power-on: what restarts with the board begins anew.
  void PowerOn();
  /// The nodes at these temperatures, as a recording found them. Before the first step what the
  /// terms hold (masses, sensors) follows; later the nodes move alone, as a plate that is held
  /// does.
  void Place(const Temperatures& temperatures);
  void Advance(double dt_s, const Inputs& inputs);

  Temperatures temperatures() const { return network_.temperatures(); }
  /// What the sensors of plate and die show of them, before quantisation.
  Temperatures shown() const { return shown_; }
  double die_k_per_s() const { return die_k_per_s_; }          ///< over the last step
  double StoredHeat() const { return network_.StoredHeat(); }  ///< above ambient [J]
  /// What flowed in from outside during the last step minus what is lost to ambient now [W].
  double NetHeatFlow() const { return network_.NetHeatFlow(flows_); }

  const std::vector<ActiveTerm>& terms() const { return terms_; }
  std::span<double> states() { return states_; }  ///< of all terms
  std::span<double> StatesOf(const ActiveTerm& term) {
    return std::span(states_).subspan(term.first_state, term.info->states);
  }

 private:
  HeatContext Context(const Inputs& inputs, double dt_s) const {
    return {inputs, model_, network_.temperatures(), dt_s};
  }
  HeatFlows Flows(const Inputs& inputs, double dt_s);
  Temperatures MiddleOfStep(double dt_s);

  Model model_;
  ThermalNetwork network_;
  std::vector<ActiveTerm> terms_;
  std::vector<double> states_;
  HeatFlows flows_;
  double die_k_per_s_ = 0;
  bool begun_ = false;
  Temperatures last_start_;  ///< what the step before began with
  double last_dt_s_ = 0;
  Temperatures shown_;
};

}  // namespace zrobench::physics
