#include "tests/blind/memory.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>

namespace zrobench::blind {
namespace {

using Index = Eigen::Index;

constexpr Index kModes = 14;

// A sum of exponentials (times from 4 s to 40000 s) that is `kernel` from 1 s to three hours.
Eigen::VectorXd Response(const Eigen::VectorXd& input,
                         const std::function<double(double)>& kernel) {
  Eigen::VectorXd tau(kModes);
  for (Index m = 0; m < kModes; ++m) {
    tau[m] = 4 * std::pow(1e4, static_cast<double>(m) / (kModes - 1));
  }
  constexpr Index kPoints = 120;
  Eigen::MatrixXd modes(kPoints, kModes);
  Eigen::VectorXd wanted(kPoints);
  for (Index i = 0; i < kPoints; ++i) {
    const double t = std::pow(1e4, static_cast<double>(i) / (kPoints - 1));
    wanted[i] = kernel(t);
    modes.row(i) = (-t / tau.array()).exp().transpose();
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(modes);
  solver.setThreshold(1e-7);
  const Eigen::VectorXd weight = solver.solve(wanted);
  const Eigen::VectorXd keep = (-1 / tau.array()).exp();
  Eigen::VectorXd state = Eigen::VectorXd::Zero(kModes);
  Eigen::VectorXd output(input.size());
  for (Index t = 0; t < input.size(); ++t) {
    const double change = t > 0 ? input[t] - input[t - 1] : 0;
    state = (state.array() * keep.array() + change).matrix();
    output[t] = weight.dot(state);
  }
  return output;
}

struct Relay {
  double on, off, weight;
};

std::vector<Relay> Plane(double half_width) {
  constexpr double kLow = 5;
  constexpr double kHigh = 60;
  std::vector<Relay> relays;
  double total = 0;
  for (double centre = kLow; centre <= kHigh; centre += 2.0) {
    for (const double share : {0.3, 0.6, 0.9, 1.2, 1.5, 1.8}) {
      const double middle = (centre - 32) / 16;
      const double weight = std::exp(-0.5 * middle * middle * share);
      relays.push_back({centre + share * half_width, centre - share * half_width, weight});
      total += weight;
    }
  }
  for (Relay& relay : relays) relay.weight /= total;
  return relays;
}

}  // namespace

Eigen::VectorXd PlayOf(const Eigen::VectorXd& input, double half_width) {
  Eigen::VectorXd output(input.size());
  double play = input.size() ? input[0] : 0;
  for (Index t = 0; t < input.size(); ++t) {
    play = std::clamp(play, input[t] - half_width, input[t] + half_width);
    output[t] = play;
  }
  return output;
}

Eigen::VectorXd RelayPlane(const Eigen::VectorXd& input, double half_width) {
  Eigen::VectorXd output = Eigen::VectorXd::Zero(input.size());
  for (const Relay& relay : Plane(half_width)) {
    double state = input[0] > 0.5 * (relay.on + relay.off) ? 1 : -1;
    for (Index t = 0; t < input.size(); ++t) {
      if (input[t] >= relay.on) state = 1;
      if (input[t] <= relay.off) state = -1;
      output[t] += relay.weight * state;
    }
  }
  return output;
}

Eigen::VectorXd Relaxation(const Eigen::VectorXd& input, double time_constant_s, double stretch) {
  if (stretch == 1) {
    const double keep = std::exp(-1 / time_constant_s);
    Eigen::VectorXd output = Eigen::VectorXd::Zero(input.size());
    for (Index t = 1; t < input.size(); ++t) {
      output[t] = output[t - 1] * keep + input[t] - input[t - 1];
    }
    return output;
  }
  return Response(input,
                  [=](double t) { return std::exp(-std::pow(t / time_constant_s, stretch)); });
}

Eigen::VectorXd HalfOrder(const Eigen::VectorXd& input, double time_constant_s) {
  return Response(input, [=](double t) { return 1 / std::sqrt(1 + t / time_constant_s); });
}

}  // namespace zrobench::blind
