#include "tests/blind/thermal.h"

#include <algorithm>
#include <cmath>

namespace zrobench::blind {
namespace {

using Index = Eigen::Index;

constexpr double kStefanBoltzmann = 5.670374419e-8;  // W / (m^2 K^4), CODATA 2018
constexpr double kZeroDegcInK = 273.15;
// Where a slab heated from one face has its mean temperature: 1 - 1/sqrt(3) of the depth. The
// plate's sensor sits in a well there.
constexpr double kNeutralDepth = 0.42264973;

double Fourth(double degc) { return std::pow(degc + kZeroDegcInK, 4); }

// What the driver really gets: stale for a while now and then.
Eigen::VectorXd StaleEvents(const std::vector<Effect>& effects) {
  Eigen::VectorXd stale = Eigen::VectorXd::Zero(kRunRows);
  const double seconds = StrengthOf(effects, "bus.stale_command");
  const double phase = ShapeOf(effects, "bus.stale_command", 0);
  if (seconds <= 0) return stale;
  for (double at = 1000 + 700 * phase; at < kRunRows - 300; at += 700) {
    const int first = static_cast<int>(at);
    const int whole = std::min(static_cast<int>(seconds), 250);
    stale.segment(first, whole).setOnes();
    stale[first + whole] = std::min(seconds - whole, 1.0);
  }
  return stale;
}

}  // namespace

ThermalRig::ThermalRig(const BaseModel& model, const Solids& solids,
                       const std::vector<Effect>& effects)
    : model_(model),
      solids_(solids),
      plate_(static_cast<std::size_t>(solids.plate_nodes)),
      nodes_(static_cast<std::size_t>(solids.plate_nodes + solids.board_nodes)) {
  const auto n = static_cast<Index>(nodes_);
  const Index p = solids.plate_nodes;
  const Index b = solids.board_nodes;
  degc_ = Eigen::VectorXd::Constant(n, model.ambient_degc);
  previous_ = degc_;
  capacity_.resize(n);
  capacity_.head(p).setConstant(model.plate_j_per_k / static_cast<double>(p));
  capacity_.tail(b).setConstant(model.board_j_per_k / static_cast<double>(b));
  link_ = Eigen::VectorXd::Zero(n);
  link_.head(p).setConstant(solids.plate_conductance_w_per_k * static_cast<double>(p));
  link_.tail(b).setConstant(solids.board_conductance_w_per_k * static_cast<double>(b));
  // From cell centre to cell centre; a lump has no inside.
  inside_k_per_w_ = (p > 1 ? 0.5 / link_[0] : 0) + (b > 1 ? 0.5 / link_[n - 1] : 0);
  passed_.resize(n);
  inverse_.resize(n);
  const auto strength = [&effects](std::string_view id) { return StrengthOf(effects, id); };
  contact_per_40k_ = strength("thermal.contact_resistance_temperature");
  parallel_w_per_k_ = strength("thermal.parallel_mass");
  parallel_s_ = ShapeOf(effects, "thermal.parallel_mass", 600);
  radiation_m2_ = solids.radiation_m2 + strength("thermal.radiation");
  convection_w_ = solids.convection_w + strength("thermal.convection");
  sensor_lag_s_ = strength("thermal.plate_sensor_lag");
  sensor_gain_ = strength("thermal.plate_sensor_gain");
  series_s_ = strength("thermal.series_mass");
  limit_pct_ = 100 - strength("thermal.saturation");
  joule_w_ = strength("thermal.peltier_joule");
  drift_k_per_h_ = strength("thermal.ambient_drift");
  self_heating_w_ = strength("thermal.self_heating");
  fan_w_per_k_ = strength("other.fan");
  fan_dwell_s_ = ShapeOf(effects, "other.fan", 600);
  die_keep_ = std::exp(-kSubstep_s / model.package_s);
  mass_degc_ = series_degc_ = die_degc_ = probe_degc_ = model.ambient_degc;
  sensed_degc_ = (1 + sensor_gain_) * probe_degc_;
  Factorise();
}

double ThermalRig::PlateDegcAtDepth() const {
  if (plate_ == 1) return degc_[0];
  const double place = kNeutralDepth * static_cast<double>(plate_) - 0.5;
  const auto below = static_cast<Index>(place);
  const double part = place - static_cast<double>(below);
  return degc_[below] * (1 - part) + degc_[below + 1] * part;
}

double ThermalRig::PlateLoss_w(double ambient_degc, double fan_w_per_k) const {
  const double plate = degc_.head(static_cast<Index>(plate_)).mean();
  const double above = plate - ambient_degc;
  double loss = fan_w_per_k * above;
  if (convection_w_ != 0)
    loss += convection_w_ * (above / 40) * std::pow(std::abs(above / 40), 0.25);
  if (radiation_m2_ != 0) {
    loss += kStefanBoltzmann * radiation_m2_ * (Fourth(plate) - Fourth(ambient_degc));
  }
  return loss;
}

// Factors of the backward Euler step's tridiagonal matrix: each cell's share passed on, and the
// reciprocal of what is left of its diagonal.
void ThermalRig::Factorise() {
  const auto n = static_cast<Index>(nodes_);
  const auto p = static_cast<Index>(plate_);
  const double contact =
      model_.board_to_plate_w_per_k * (1 + contact_per_40k_ * (degc_[p] - kReferenceDegc) / 40);
  link_[p - 1] = 1 / (1 / contact + inside_k_per_w_);
  Eigen::VectorXd diagonal = capacity_ / kSubstep_s;
  diagonal.head(p).array() += model_.plate_to_ambient_w_per_k / static_cast<double>(p);
  diagonal[n - 1] += model_.board_to_ambient_w_per_k;
  for (Index i = 0; i + 1 < n; ++i) {
    diagonal[i] += link_[i];
    diagonal[i + 1] += link_[i];
  }
  for (Index i = 0; i < n; ++i) {
    inverse_[i] = 1 / diagonal[i];
    passed_[i] = link_[i] * inverse_[i];
    if (i + 1 < n) diagonal[i + 1] -= passed_[i] * link_[i];
  }
}

void ThermalRig::Solve(double heat_w, double ambient_degc) {
  const auto n = static_cast<Index>(nodes_);
  const auto p = static_cast<Index>(plate_);
  if (contact_per_40k_ != 0) Factorise();
  previous_ = degc_;
  degc_ = capacity_.cwiseProduct(degc_) / kSubstep_s;
  degc_.head(p).array() += model_.plate_to_ambient_w_per_k / static_cast<double>(p) * ambient_degc;
  degc_[0] += heat_w;
  degc_[n - 1] += model_.board_to_ambient_w_per_k * ambient_degc + self_heating_w_ -
                  parallel_w_per_k_ * (previous_[n - 1] - mass_degc_);
  for (Index i = 0; i + 1 < n; ++i) degc_[i + 1] += passed_[i] * degc_[i];
  degc_[n - 1] *= inverse_[n - 1];
  for (Index i = n - 1; i-- > 0;) degc_[i] = degc_[i] * inverse_[i] + passed_[i] * degc_[i + 1];
}

void ThermalRig::Board(double ambient_degc) {
  const auto n = static_cast<Index>(nodes_);
  const double top = 0.5 * (degc_[n - 1] + previous_[n - 1]);
  double feels = top;
  if (series_s_ > 0) {
    // The mean over the step, exact for a constant input: no lag of its own as the mass vanishes.
    const double keep = std::exp(-kSubstep_s / series_s_);
    feels = top + (series_degc_ - top) * (1 - keep) * series_s_ / kSubstep_s;
    series_degc_ = top + (series_degc_ - top) * keep;
  }
  die_degc_ = feels + (die_degc_ - feels) * die_keep_;
  if (parallel_w_per_k_ != 0) {
    mass_degc_ = top + (mass_degc_ - top) * std::exp(-kSubstep_s / parallel_s_);
  }
  const auto p = static_cast<Index>(plate_);
  const double lost = model_.plate_to_ambient_w_per_k * (degc_.head(p).mean() - ambient_degc) +
                      model_.board_to_ambient_w_per_k * (degc_[n - 1] - ambient_degc);
  entered_j_ -= lost * kSubstep_s;
}

void ThermalRig::Step(double command_pct, double time_s, double draft_k) {
  const double u = std::clamp(command_pct, -limit_pct_, limit_pct_) / 100;
  const double heat = (u > 0 ? model_.heater_w : model_.cooler_w) * u + joule_w_ * u * u;
  const double ambient = model_.ambient_degc + draft_k + drift_k_per_h_ * time_s / 3600;
  const bool fan = std::fmod(time_s, 2.3 * fan_dwell_s_) > fan_dwell_s_;
  const double net = heat - PlateLoss_w(ambient, fan ? fan_w_per_k_ : 0.0);
  Solve(net, ambient);
  entered_j_ += net * kSubstep_s;
  Board(ambient);
  const double plate = PlateDegcAtDepth();
  if (sensor_lag_s_ > 0) {
    probe_degc_ = plate + (probe_degc_ - plate) * std::exp(-kSubstep_s / sensor_lag_s_);
  } else {
    probe_degc_ = plate;
  }
  sensed_degc_ = (1 + sensor_gain_) * probe_degc_;
}

HeatAccount ThermalRig::account() const {
  const double stored = capacity_.dot((degc_.array() - model_.ambient_degc).matrix());
  return {.stored_j = stored, .entered_j = entered_j_};
}

ThermalPath RunThermal(const BaseModel& model, const Solids& solids,
                       const std::vector<Effect>& effects, const Controller& command,
                       const Eigen::VectorXd& draft_k) {
  ThermalRig rig(model, solids, effects);
  const Eigen::VectorXd stale = StaleEvents(effects);
  const double dead_s = StrengthOf(effects, "thermal.dead_time");
  ThermalPath path{Eigen::VectorXd(kRunRows), Eigen::VectorXd(kRunRows), Eigen::VectorXd(kRunRows)};
  // Zeros: at a row's end the command to come is asked for, times nothing.
  Eigen::VectorXd applied = Eigen::VectorXd::Zero(kRunRows);
  Eigen::VectorXd integral = Eigen::VectorXd::Zero(kRunRows + 1);  // of the applied command
  const auto integral_at = [&](double s) {
    if (s <= 0) return 0.0;
    const auto row = std::min(static_cast<Index>(s), static_cast<Index>(kRunRows - 1));
    return integral[row] + applied[row] * (s - static_cast<double>(row));
  };
  for (Index row = 0; row < kRunRows; ++row) {
    const double wanted = command(static_cast<int>(row), rig.plate_degc());
    path.command_pct[row] = wanted;
    const double held = row > 0 ? applied[row - 1] : wanted;
    applied[row] = wanted + stale[row] * (held - wanted);
    integral[row + 1] = integral[row] + applied[row];
    double plate = 0;
    double die = 0;
    for (int sub = 0; sub < kSubsteps; ++sub) {
      const double begin = static_cast<double>(row) + sub * kSubstep_s - dead_s;
      const double mean = (integral_at(begin + kSubstep_s) - integral_at(begin)) / kSubstep_s;
      plate += 0.5 * rig.plate_degc();
      die += 0.5 * rig.die_degc();
      rig.Step(mean, begin + dead_s, draft_k.size() ? draft_k[row] : 0.0);
      plate += 0.5 * rig.plate_degc();
      die += 0.5 * rig.die_degc();
    }
    path.plate_degc[row] = plate / kSubsteps;
    path.die_degc[row] = die / kSubsteps;
  }
  return path;
}

}  // namespace zrobench::blind
