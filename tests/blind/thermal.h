#pragma once
// Heat flow of plate, contact and board as a one-dimensional chain of finite volumes, solved
// implicitly. With one volume a solid it is the base model itself.
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tests/blind/bench.h"
#include "tests/blind/effects.h"
#include "tests/blind/schedule.h"

namespace zrobench::blind {

inline constexpr int kSubsteps = 4;  ///< of a row
inline constexpr double kSubstep_s = 1.0 / kSubsteps;

/// Means over each row, before noise and registers. kRunRows elements each.
struct ThermalPath {
  Eigen::VectorXd plate_degc;  ///< what the plate's sensor feels
  Eigen::VectorXd die_degc;    ///< what the gyro feels
  Eigen::VectorXd command_pct;
};

/// Heat in and out since power-on [J], for the balance.
struct HeatAccount {
  double stored_j = 0;
  double entered_j = 0;
};

class ThermalRig {
 public:
  /// All at the ambient temperature. Keeps copies.
  ThermalRig(const BaseModel& model, const Solids& solids, const std::vector<Effect>& effects);

  /// One sub-step with `command_pct` the command averaged over it (dead time included) at `time_s`
  /// after power-on; `draft_k` adds to the ambient.
  void Step(double command_pct, double time_s, double draft_k);

  double plate_degc() const { return sensed_degc_; }  ///< through the sensor's lag and gain
  double die_degc() const { return die_degc_; }
  HeatAccount account() const;

 private:
  double PlateDegcAtDepth() const;
  void Factorise();
  void Solve(double heat_w, double ambient_degc);
  void Board(double ambient_degc);
  double PlateLoss_w(double ambient_degc, double fan_w_per_k) const;

  BaseModel model_;
  Solids solids_;
  std::size_t plate_, nodes_;
  Eigen::VectorXd degc_, capacity_, link_, previous_;
  Eigen::VectorXd passed_, inverse_;
  double inside_k_per_w_ = 0;
  // Strengths, looked up once.
  double contact_per_40k_, parallel_w_per_k_, parallel_s_, radiation_m2_, convection_w_;
  double sensor_lag_s_, sensor_gain_, series_s_, die_keep_;
  double limit_pct_, joule_w_, drift_k_per_h_, self_heating_w_, fan_w_per_k_, fan_dwell_s_;
  double mass_degc_, series_degc_, die_degc_, probe_degc_, sensed_degc_;
  double entered_j_ = 0;
};

/// Turns a plate reading into the command of the next second [%].
using Controller = std::function<double(int row, double plate_degc)>;

/// One power-on with the commands given by `command` row by row (it sees the plate's sensor at the
/// row's begin). `draft_k` is empty or has kRunRows elements.
ThermalPath RunThermal(const BaseModel& model, const Solids& solids,
                       const std::vector<Effect>& effects, const Controller& command,
                       const Eigen::VectorXd& draft_k);

}  // namespace zrobench::blind
