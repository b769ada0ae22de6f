#pragma once
// Weighs a difference between two noiseless recordings by the noise the generator knows: white
// noise and registers on every channel, 1/f on the gyro's axes, drafts through the heat flow.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "tests/blind/bench.h"
#include "tests/blind/respond.h"

namespace zrobench::blind {

/// A sum of Ornstein-Uhlenbeck states, a decade apart, that is 1/f within 11 % from 1/(2 h) up to
/// half a block's rate; a test holds it to that.
struct FlickerStates {
  std::vector<double> time_s;
  double sigma = 0;  ///< rms of each
};
FlickerStates FlickerAs(double flicker_dps);
/// One-sided density of the sum at `hz` [dps^2/Hz].
double DensityOf(const FlickerStates& states, double hz);

/// Innovations filter of the joint linear model: state (plate, board, die, draft, flicker of each
/// axis), measured as block means. Its gains depend on the noise alone, so it whitens any signal.
/// Temperatures at power-on are left free.
class Whitener {
 public:
  /// `die_degc`: stacked recording whose die temperatures fix the slope of the gyro's cubic.
  Whitener(const BaseModel& model, const Instruments& noise, const Eigen::VectorXd& stacked,
           std::size_t runs);

  /// Columns are stacked signals; the result has unit variance where the input was pure noise.
  Eigen::MatrixXd Whiten(const Eigen::MatrixXd& signals) const;

 private:
  struct Gain {
    Eigen::VectorXd gain;
    double deviation = 1;
  };

  void Prepare(const BaseModel& model, const Instruments& noise);
  void Riccati(const Eigen::VectorXd& stacked);
  Eigen::VectorXd Row(Eigen::Index channel, double slope) const;

  std::size_t runs_;
  std::array<std::array<double, 4>, 3> zro_dps_;
  Eigen::MatrixXd transition_, process_, start_;
  Eigen::VectorXd variance_;   ///< of each channel's white part, a block's mean
  std::vector<Gain> gains_;    ///< run, block, channel
  std::vector<double> slope_;  ///< run, block, axis [dps/K]
  Eigen::Index flickers_ = 0;
};

}  // namespace zrobench::blind
