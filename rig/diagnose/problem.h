#pragma once
// A case made ready to be fitted, and the points at which a model of it is evaluated.
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "rig/diagnose/case.h"
#include "rig/diagnose/gyro_noise.h"
#include "rig/diagnose/series.h"
#include "rig/diagnose/thermal_path.h"

namespace zrobench::diagnose {

struct Problem {
  physics::Model nominal;          ///< no terms; their parameters as the station states them
  std::vector<std::string> known;  ///< terms of the station's own simulation
  std::vector<Series> series;
  Drive drive = Drive::kNothing;
  std::array<bool, kMeasured> measured{};  ///< channels that hold values and that the model has

  /// The model keeps only what the recording can feed: without drive and plate no plate, ...
  static Problem Of(const Case& loaded);
  /// The same with some of the runs.
  Problem Only(const std::vector<std::size_t>& runs) const;

  double block_s() const { return series.front().grid.block_s(); }
  /// The cubic's variable: (T - reference) / kSpan_k, so that its coefficients are alike in size.
  static constexpr double kSpan_k = 40;
  Eigen::ArrayXd X(const Eigen::ArrayXd& die_degc) const;
  Eigen::Index rows() const;  ///< of a stacked vector: runs x channels x blocks
};

/// Noise of all channels of a problem.
struct Noise {
  ThermalNoise thermal;
  std::array<GyroNoise, 3> gyro;
};

/// Where the thermal model stands: the station's model with its terms, and the die sensor's offset.
struct Point {
  physics::Model model;
  double die_offset_k = 0;
};

/// One thermal parameter that is fitted.
struct Knob {
  std::string name;  ///< key in a station file
  std::function<double&(Point&)> of;
  bool logarithmic = true;  ///< steps are relative; else in `unit`
  double prior_sd = 0.7;    ///< about the nominal value, in steps
  double probe = 1e-3;      ///< step of the finite difference
  double unit = 1;
  bool sound = false;  ///< moves how sound meets the gyro, not the temperatures

  void Move(Point& point, double step) const;
  /// From the nominal value, in steps.
  double Distance(const Point& point, const Point& nominal) const;
};
/// The base model's knobs that the recording can move.
std::vector<Knob> BaseKnobs(const Problem& problem);
/// Resonances and their quality, as far from their nominal values as a sweep leaves them.
std::vector<Knob> SoundKnobs();

/// The thermal model at one point, filtered with the data.
struct Evaluated {
  std::vector<ThermalPath> path;                ///< a run each; empty without a plate
  std::vector<ThermalFilter::Output> filtered;  ///< likewise
  std::vector<Eigen::ArrayXd> die, die_fine;    ///< best estimate of the die [degC]: blocks, steps
};

/// Filters for one noise model, built about one point (their gains depend weakly on it).
class Filters {
 public:
  Filters(const Problem& problem, const Point& about, const Noise& noise);

  Evaluated Evaluate(const Point& point) const;
  /// Whitened innovations of the temperatures and whitened rates, stacked.
  Eigen::VectorXd Residual(const Evaluated& at) const;
  /// The same with the temperatures alone, filtered anew: `at` may come from other filters.
  Eigen::VectorXd TemperatureResidual(const Evaluated& at) const;
  /// Change of the whitened predictions, stacked, when the thermal model goes from `at` to `moved`;
  /// `slope_dps_per_k` (run, axis): of the offset over the die's temperature, a block each.
  using Slopes = std::vector<std::array<Eigen::ArrayXd, 3>>;
  Eigen::VectorXd ThermalColumn(const Evaluated& at, const Evaluated& moved,
                                const Slopes& slope_dps_per_k) const;
  /// Whitened change of one axis' rates, stacked; a run each, empty runs are zero.
  Eigen::VectorXd RateColumn(std::size_t axis, const std::vector<Eigen::ArrayXd>& rates) const;

  double thermal_log_determinant() const;

 private:
  Eigen::VectorXd::SegmentReturnType Segment(Eigen::VectorXd& stack, std::size_t run,
                                             std::size_t channel) const;
  const Problem& problem_;
  std::vector<ThermalFilter> thermal_;            ///< a run each
  std::vector<std::vector<NoiseWhitener>> rate_;  ///< run, axis
  std::vector<Eigen::Index> first_;               ///< a run's first row
};

}  // namespace zrobench::diagnose
