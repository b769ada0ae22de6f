#include "rig/diagnose/effect.h"

#include <algorithm>
#include <utility>

namespace zrobench::diagnose {
namespace {

using physics::ParameterInfo;
using physics::TermInfo;

double TypicalOf(const ParameterInfo& p) { return p.typical != 0 ? p.typical : 1; }

using Rates = std::array<Eigen::ArrayXd, 3>;

/// What the terms add to the rates together, as block means along the die's temperature.
Rates Answer(const std::vector<physics::ActiveTerm>& terms, const Series& series,
             const Eigen::ArrayXd& die_fine) {
  std::size_t size = 0;
  for (const physics::ActiveTerm& term : terms) size += term.info->states;
  std::vector<double> states(size);
  double die = die_fine[0];
  for (const physics::ActiveTerm& term : terms) {
    const auto own = std::span(states).subspan(term.first_state, term.info->states);
    term.info->term->Place({die, die, die}, own);
    term.info->term->PowerOn(own);
  }
  Rates means;
  means.fill(Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(series.blocks())));
  const double weight = 1 / static_cast<double>(series.grid.steps_per_block);
  for (std::size_t i = 0; i < series.inputs.size(); ++i) {
    const double before = std::exchange(die, die_fine[static_cast<Eigen::Index>(i)]);
    const physics::TermContext context{.inputs = series.inputs[i],
                                       .temperatures = {die, die, die},
                                       .sample_period_s = series.grid.step_s,
                                       .die_k_per_s = (die - before) / series.grid.step_s};
    physics::Sensed sensed;
    physics::ActOnSample(terms, context, states, sensed);
    const auto block = static_cast<Eigen::Index>(i / series.grid.steps_per_block);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      means[axis][block] += weight * sensed.rate_dps[axis];
    }
  }
  return means;
}

/// The effect alone; beside the terms that the station knows where it acts through them.
Rates AnswerOf(const Effect& effect, const std::vector<double>& coefficients,
               const Problem& problem, const physics::Model& model, std::size_t run,
               const Eigen::ArrayXd& die_fine) {
  std::vector<physics::ActiveTerm> terms;
  std::size_t states = 0;
  const auto add = [&](const TermInfo& info, std::vector<double> parameters) {
    terms.push_back({&info, std::move(parameters), states});
    states += info.states;
  };
  if (!effect.info->linear) {
    for (const Effect& known : KnownEffects(problem)) {
      if (known.info == effect.info || IsThermal(*known.info)) continue;
      add(*known.info, physics::FlatParameters(*known.info, model));
    }
  }
  add(*effect.info, ParametersOf(effect, coefficients, model));
  return Answer(terms, problem.series[run], die_fine);
}

/// Change with the coefficients, from zero.
Rates Change(const Effect& effect, const std::vector<double>& coefficients, const Problem& problem,
             const physics::Model& model, std::size_t run, const Eigen::ArrayXd& die_fine) {
  if (effect.info->linear) return AnswerOf(effect, coefficients, problem, model, run, die_fine);
  constexpr double kProbe = 0.1;
  std::vector<double> few = coefficients;
  for (double& c : few) c *= kProbe;
  Rates change = AnswerOf(effect, few, problem, model, run, die_fine);
  const std::vector<double> none(coefficients.size());
  const Rates at_rest = AnswerOf(effect, none, problem, model, run, die_fine);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    change[axis] = (change[axis] - at_rest[axis]) / kProbe;
  }
  return change;
}

}  // namespace

std::vector<Coefficient> CoefficientsOf(const TermInfo& info) {
  std::vector<Coefficient> all;
  for (const ParameterInfo& p : info.parameters) {
    if (!p.coefficient) continue;
    for (std::size_t i = 0; i < p.defaults.size(); ++i) {
      all.push_back({std::string(p.name), p.defaults.size() == 3 ? static_cast<int>(i) : -1,
                     TypicalOf(p), std::string(p.unit)});
    }
  }
  return all;
}

bool IsThermal(const TermInfo& info) {
  return info.id.starts_with("thermal.") || info.id.starts_with("time.");
}

std::vector<Effect> Shapes(const TermInfo& info) {
  std::vector<Effect> all = {{&info, {}}};
  for (const ParameterInfo& p : info.parameters) {
    if (p.coefficient) continue;
    const std::vector<double> grid =
        p.grid.empty() ? std::vector<double>{p.defaults.front()} : p.grid;
    std::vector<Effect> more;
    for (const Effect& effect : all) {
      for (const double value : grid) {
        more.push_back(effect);
        more.back().shape.push_back(value);
      }
    }
    all = std::move(more);
  }
  return all;
}

std::vector<double> ParametersOf(const Effect& effect, const std::vector<double>& coefficients,
                                 const physics::Model& model) {
  std::vector<double> flat = physics::FlatParameters(*effect.info, model);
  std::size_t at = 0, coefficient = 0, shape = 0;
  for (const ParameterInfo& p : effect.info->parameters) {
    for (std::size_t i = 0; i < p.defaults.size(); ++i) {
      flat[at++] = p.coefficient ? coefficients[coefficient++] * TypicalOf(p) : effect.shape[shape];
    }
    if (!p.coefficient) ++shape;
  }
  return flat;
}

void Install(const Effect& effect, Point& point) {
  const std::string id(effect.info->id);
  point.model.terms.push_back(id);
  std::size_t shape = 0;
  for (const ParameterInfo& p : effect.info->parameters) {
    const double value = p.coefficient ? 0 : effect.shape[shape++];
    point.model.term[id][std::string(p.name)] = std::vector<double>(p.defaults.size(), value);
  }
}

std::vector<Knob> EffectKnobs(const Effect& effect) {
  std::vector<Knob> knobs;
  const std::string id(effect.info->id);
  for (const ParameterInfo& p : effect.info->parameters) {
    if (!p.coefficient) continue;
    for (std::size_t i = 0; i < p.defaults.size(); ++i) {
      const std::string name(p.name);
      knobs.push_back({.name = id + "." + name,
                       .of = [id, name, i](Point& point) -> double& {
                         return point.model.term.at(id).at(name)[i];
                       },
                       .logarithmic = false,
                       .prior_sd = 1e4,
                       .probe = 0.05,
                       .unit = TypicalOf(p)});
    }
  }
  return knobs;
}

std::vector<Effect> KnownEffects(const Problem& problem) {
  std::vector<Effect> known;
  for (const std::string& id : problem.known) {
    const TermInfo& info = *physics::FindTerm(id);
    if (!info.scanned || info.needs_every_sample ||
        (IsThermal(info) && problem.drive == Drive::kNothing))
      continue;
    Effect effect{&info, {}};
    const std::vector<double> flat = physics::FlatParameters(info, problem.nominal);
    std::size_t at = 0;
    for (const ParameterInfo& p : info.parameters) {
      if (!p.coefficient) effect.shape.push_back(flat[at]);
      at += p.defaults.size();
    }
    known.push_back(std::move(effect));
  }
  return known;
}

std::vector<RateResponse> RateResponses(const Effect& effect, const Problem& problem,
                                        const physics::Model& model, const Evaluated& at) {
  const std::vector<Coefficient> coefficients = CoefficientsOf(*effect.info);
  std::vector<RateResponse> responses(coefficients.size());
  for (std::size_t first = 0; first < coefficients.size();) {
    // The axes' values of one parameter act each on its own axis: one simulation serves them all.
    std::vector<double> values(coefficients.size());
    std::size_t last = first;
    do {
      values[last++] = 1;
    } while (last < coefficients.size() && coefficients[last].axis > 0);
    for (std::size_t run = 0; run < problem.series.size(); ++run) {
      const Rates rates = Change(effect, values, problem, model, run, at.die_fine[run]);
      for (std::size_t k = first; k < last; ++k) {
        auto& mine = responses[k].rates.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool touches =
              coefficients[k].axis < 0 || coefficients[k].axis == static_cast<int>(axis);
          if (touches && problem.measured[kRateX + axis]) mine[axis] = rates[axis];
        }
      }
    }
    first = last;
  }
  return responses;
}

}  // namespace zrobench::diagnose
