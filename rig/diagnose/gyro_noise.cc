#include "rig/diagnose/gyro_noise.h"

#include <cmath>
#include <numbers>

namespace zrobench::diagnose {

namespace {

/// Variance that a block's mean keeps of the bank's faster members, which are not carried along: an
/// Ornstein-Uhlenbeck process of time constant tau and unit variance, averaged over h, has
/// (2 tau / h) (1 - (tau / h) (1 - exp(-h / tau))).
double FasterThanBlocks(double block_s) {
  double kept = 0;
  for (double tau = NoiseWhitener::kTau_s[0] / NoiseWhitener::kRatio; tau > 0.01 * block_s;
       tau /= NoiseWhitener::kRatio) {
    const double share = tau / block_s;
    kept += 2 * share * (1 - share * (1 - std::exp(-1 / share)));
  }
  return kept;
}

}  // namespace

GyroNoise GyroNoise::Nominal(const physics::GyroModel& gyro, double block_s) {
  return {gyro.noise_density_dps_per_rthz / std::sqrt(2 * block_s), gyro.flicker_dps};
}

NoiseWhitener::NoiseWhitener(const GyroNoise& noise, double block_s,
                             const std::vector<bool>& measured) {
  const double variance =
      noise.flicker_dps * noise.flicker_dps * std::log(kRatio) / (2 * std::numbers::pi);
  Bank kick;
  for (std::size_t i = 0; i < kTau_s.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    decay_[k] = std::exp(-block_s / kTau_s[i]);
    kick[k] = variance * (1 - decay_[k] * decay_[k]);
  }
  const double white = noise.white_dps * noise.white_dps + variance * FasterThanBlocks(block_s);
  using Covariance = Eigen::Matrix<double, kTau_s.size(), kTau_s.size()>;
  Covariance p = Bank::Constant(variance).asDiagonal();
  steps_.reserve(measured.size());
  for (const bool here : measured) {
    Step step{Bank::Zero(), 0};
    if (here) {
      const Bank seen = p.rowwise().sum();
      const double s = seen.sum() + white;
      step = {seen / s, 1 / std::sqrt(s)};
      p -= step.gain * seen.transpose();
      log_determinant_ += std::log(s);
    }
    steps_.push_back(step);
    p = (decay_ * decay_.transpose()).cwiseProduct(p);
    p.diagonal() += kick;
  }
}

Eigen::ArrayXd NoiseWhitener::Whiten(const Eigen::ArrayXd& series) const {
  Eigen::ArrayXd white = Eigen::ArrayXd::Zero(series.size());
  Bank x = Bank::Zero();
  for (Eigen::Index k = 0; k < series.size(); ++k) {
    const Step& step = steps_[static_cast<std::size_t>(k)];
    if (step.whiten > 0) {
      const double innovation = series[k] - x.sum();
      white[k] = innovation * step.whiten;
      x += step.gain * innovation;
    }
    x = x.cwiseProduct(decay_);
  }
  return white;
}

}  // namespace zrobench::diagnose
