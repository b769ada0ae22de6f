#pragma once
// The plug-in interface of everything the simulation knows beyond the base model, and its
// catalogue. The same objects serve the rig run forward and the diagnosis that fits them: a term
// holds nothing; its parameters and its states are flat vectors that the caller owns, so a finite
// difference is a changed number.
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/physics/model.h"
#include "rig/physics/rig_model.h"

namespace zrobench::physics {

/// What a term may look at when it acts on one sensor sample.
struct TermContext {
  const Inputs& inputs;
  Temperatures temperatures;
  double sample_period_s = 0;
  /// Independent unit normals, two an axis, anew each sample; zero unless noise sounds.
  std::array<std::array<double, 2>, 3> normals{};
  double die_k_per_s = 0;      ///< how fast the die's temperature moves
  double resonance_scale = 1;  ///< mechanical resonances stand at this multiple of their nominal
  /// Asked for the offset itself, without noise: what only rounds or clips stays away.
  bool truth = false;
};

/// How the world's sound meets the gyro: what terms change about it.
struct Heard {
  double tone_pa = 0;  ///< rms pressure at the package
  double resonance_scale = 1;
};

/// What a term may look at when heat moves.
struct HeatContext {
  const Inputs& inputs;
  const Model& model;
  Temperatures temperatures;  ///< foreseen for the middle of the step; in Show: at its end
  double dt_s = 0;
  double drive_pct = 0;  ///< in Heat: what reaches the plate's actuator
};

/// One effect. Stateless; every hook does nothing unless overridden. `parameters` has the layout
/// FlatParameters gives, `states` has TermInfo::states elements.
/// A term whose coefficients are zero leaves every number of the base model as it was, bit by bit.
class Term {
 public:
  virtual ~Term() = default;
  /// The states when the rig, or a recording, begins at these temperatures; a PowerOn follows.
  virtual void Place(const Temperatures& at, std::span<double> states) const;
  /// The states at the start of a power-on. What is warm stays warm: only the board restarts.
  virtual void PowerOn(std::span<double> states) const;
  /// Changes what the other terms hear of the sound; before any term's Step. context is still that
  /// of the sound as it is played. Moves on by one sample period what sound alone moves.
  virtual void Sound(const TermContext& context, std::span<const double> parameters,
                     std::span<double> states, Heard& heard) const;
  /// Moves the states on by one sample period, before Output.
  virtual void Step(const TermContext& context, std::span<const double> parameters,
                    std::span<double> states) const;
  /// Adds to what the sensors show; `sensed` holds the base model and the terms before this one.
  virtual void Output(const TermContext& context, std::span<const double> parameters,
                      std::span<const double> states, Sensed& sensed) const;
  /// Once a heat step, in this order. What reaches the plate's actuator of `drive_pct`.
  virtual double Drive(const HeatContext& context, std::span<const double> parameters,
                       std::span<double> states, double drive_pct) const;
  /// Adds heat that the base model does not know; moves the term's own masses on by dt_s.
  virtual void Heat(const HeatContext& context, std::span<const double> parameters,
                    std::span<double> states, HeatFlows& flows) const;
  /// Changes what the plate's and the die's sensors show; context is that of the step's end.
  virtual void Show(const HeatContext& context, std::span<const double> parameters,
                    std::span<double> states, Temperatures& shown) const;
};

struct ParameterInfo {
  std::string_view name;
  std::string_view unit;
  std::vector<double> defaults;  ///< its size is the parameter's: 1, or 3 for one per axis
  double typical = 0;            ///< magnitude worth calling 1
  bool coefficient = false;      ///< zero switches the effect off; else a shape parameter
  bool positive = false;         ///< must be > 0
  std::string_view sign;         ///< what a positive value does, or what the value means
  /// Values worth trying: of a shape parameter (empty: keep what the model states), and of a
  /// coefficient whose effect does not begin in proportion to it. Per axis, all axes alike.
  std::vector<double> grid = {};
  bool not_negative = false;  ///< must be >= 0: differences at zero are taken upwards
};

struct TermInfo {
  std::string_view id;        ///< family.effect
  std::string_view sentence;  ///< for people: what happens
  std::string_view equation;
  std::string_view source;
  std::vector<ParameterInfo> parameters;
  std::string_view borrows;  ///< id of a term whose parameters follow this one's own, or empty
  std::vector<std::string_view> channels;    ///< columns it touches
  std::vector<std::string_view> lookalikes;  ///< ids, or words for nuisance parameters
  std::string_view excitation;               ///< what must happen for it to show
  std::size_t states = 0;
  const Term* term = nullptr;  ///< never null in the catalogue; lives as long as the program
  /// Columns of a recording without which the term is not testable; "a|b": either will do.
  std::vector<std::string_view> needs = {};
  bool from_power_on = false;    ///< counts the time since power-on, which must be known
  bool needs_power_ons = false;  ///< one power-on cannot tell it from a constant or a drift
  /// In proportion to its coefficients, the shape given; else only while they are small.
  bool linear = true;
  /// Acts from sample to sample (a line, a fold, a stair): only rows that are the sensor's own
  /// samples show it; stepped more slowly, it folds into something that was never there.
  bool needs_every_sample = false;
  bool scanned = true;  ///< false: run forward only, for what a difference cannot find
};

/// Every term there is, by id. Valid as long as the program runs.
std::span<const TermInfo> Catalogue();
/// Null when there is no such term.
const TermInfo* FindTerm(std::string_view id);
/// The known id most like `id`, for an error message.
std::string_view NearestTerm(std::string_view id);
/// Those of `info.needs` that these columns do not meet.
std::vector<std::string_view> UnmetNeeds(const TermInfo& info,
                                         std::span<const std::string> columns);

/// The values of `info`'s parameters in the catalogue's order, then of the term it borrows from,
/// and so on: what the model states, else the defaults. `model` is valid (Validate).
std::vector<double> FlatParameters(const TermInfo& info, const Model& model);

/// A term that the model switches on. Terms that are off do not appear, so they cost nothing.
struct ActiveTerm {
  const TermInfo* info = nullptr;
  std::vector<double> parameters;
  std::size_t first_state = 0;  ///< in the vector of all active terms' states
};
/// In the model's order of application. `model` is valid (Validate).
std::vector<ActiveTerm> ActiveTerms(const Model& model);

/// One sensor sample: lets all terms act on the sound, then move on and add to `sensed`.
/// `all_states` is indexed by ActiveTerm::first_state.
void ActOnSample(std::span<const ActiveTerm> terms, const TermContext& context,
                 std::span<double> all_states, Sensed& sensed);

}  // namespace zrobench::physics
