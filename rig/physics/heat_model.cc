#include "rig/physics/heat_model.h"

#include <algorithm>

namespace zrobench::physics {

HeatModel::HeatModel(const Model& model)
    : model_(model), network_(model), terms_(ActiveTerms(model)), shown_(network_.temperatures()) {
  std::size_t states = 0;
  for (const ActiveTerm& term : terms_) states += term.info->states;
  states_.resize(states);
  Place(network_.temperatures());
  PowerOn();
}

void HeatModel::Reset() {
  network_.Reset();
  begun_ = false;
  Place(network_.temperatures());
}

void HeatModel::PowerOn() {
  for (const ActiveTerm& term : terms_) term.info->term->PowerOn(StatesOf(term));
}

void HeatModel::Place(const Temperatures& temperatures) {
  network_.Place(temperatures);
  shown_ = network_.temperatures();
  if (begun_) return;
  last_dt_s_ = 0;
  die_k_per_s_ = 0;
  for (const ActiveTerm& term : terms_) term.info->term->Place(shown_, StatesOf(term));
}

void HeatModel::Advance(double dt_s, const Inputs& inputs) {
  begun_ = true;
  const double before_degc = network_.temperatures().die_degc;
  flows_ = Flows(inputs, dt_s);
  network_.Advance(dt_s, flows_);
  shown_ = network_.temperatures();
  if (dt_s > 0) die_k_per_s_ = (shown_.die_degc - before_degc) / dt_s;
  const HeatContext after = Context(inputs, dt_s);
  for (const ActiveTerm& term : terms_) {
    term.info->term->Show(after, term.parameters, StatesOf(term), shown_);
  }
}

Temperatures HeatModel::MiddleOfStep(double dt_s) {
  const Temperatures start = network_.temperatures();
  // Between two starts, so that a plate that is held as recorded has its slope, too.
  // No further ahead than it has been seen to move.
  const double ahead = last_dt_s_ > 0 ? std::min(1.0, dt_s / last_dt_s_) / 2 : 0;
  const Temperatures middle = {
      start.plate_degc + ahead * (start.plate_degc - last_start_.plate_degc),
      start.board_degc + ahead * (start.board_degc - last_start_.board_degc),
      start.die_degc + ahead * (start.die_degc - last_start_.die_degc)};
  last_start_ = start;
  last_dt_s_ = dt_s;
  return middle;
}

HeatFlows HeatModel::Flows(const Inputs& inputs, double dt_s) {
  HeatContext context{inputs, model_, {}, dt_s};
  if (!terms_.empty()) context.temperatures = MiddleOfStep(dt_s);
  double drive_pct = inputs.drive_pct;
  for (const ActiveTerm& term : terms_) {
    drive_pct = term.info->term->Drive(context, term.parameters, StatesOf(term), drive_pct);
  }
  context.drive_pct = drive_pct;
  HeatFlows flows{network_.PlateHeat(drive_pct), inputs.load_w, 0};
  for (const ActiveTerm& term : terms_) {
    term.info->term->Heat(context, term.parameters, StatesOf(term), flows);
  }
  return flows;
}

}  // namespace zrobench::physics
