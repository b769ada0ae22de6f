#pragma once
// The gyro's own noise as the likelihood sees it: white, and flicker as a bank of slow processes.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "rig/physics/model.h"

namespace zrobench::diagnose {

/// White noise and flicker of block means.
struct GyroNoise {
  double white_dps = 0;    ///< sd of a block's mean
  double flicker_dps = 0;  ///< B of S(f) = B^2 / (2 pi f)

  static GyroNoise Nominal(const physics::GyroModel& gyro, double block_s);
};

/// Kalman filter of white noise plus Ornstein-Uhlenbeck processes a factor kRatio apart, of equal
/// variance B^2 ln(kRatio) / (2 pi) each (their sum is flicker: physics/noise.h says why). Turns a
/// series into one that is white with unit variance when the noise is as stated. Linear, so
/// sensitivities go through it as well. White-noise tests name something in nearly every clean
/// recording; a state-space model of the flicker is what prevents that.
class NoiseWhitener {
 public:
  /// `measured`: blocks without a value keep the processes going and give 0.
  NoiseWhitener(const GyroNoise& noise, double block_s, const std::vector<bool>& measured);

  Eigen::ArrayXd Whiten(const Eigen::ArrayXd& series) const;
  /// Sum over blocks of log S: what the likelihood needs beside the innovations.
  double log_determinant() const { return log_determinant_; }

  static constexpr double kRatio = 5;
  static constexpr std::array<double, 5> kTau_s = {12, 60, 300, 1500, 7500};

 private:
  using Bank = Eigen::Matrix<double, kTau_s.size(), 1>;
  struct Step {
    Bank gain;
    double whiten = 0;  ///< 1 / sd of the innovation; 0 where nothing was measured
  };
  Bank decay_;
  std::vector<Step> steps_;
  double log_determinant_ = 0;
};

}  // namespace zrobench::diagnose
