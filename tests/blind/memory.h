#pragma once
// Parts of a gyro's offset that remember: play, a plane of relays, and stretched relaxation.
#include <Eigen/Core>

namespace zrobench::blind {

/// Play of `half_width` (same unit as `input`): follows only when pushed.
Eigen::VectorXd PlayOf(const Eigen::VectorXd& input, double half_width);

/// Mean output (-1 ... 1) of a Preisach plane of relays: thresholds centred over the input's range,
/// half widths spread round `half_width`. Not a sum of plays: its minor loops are not congruent,
/// because wide relays sit at its middle only.
Eigen::VectorXd RelayPlane(const Eigen::VectorXd& input, double half_width);

/// Integral of exp(-((t - t') / time_constant)^stretch) d input(t'), rows 1 s apart: what is left
/// of every past change. stretch = 1 is a single exponential.
Eigen::VectorXd Relaxation(const Eigen::VectorXd& input, double time_constant_s, double stretch);

/// The same with the kernel (1 + t / time_constant)^(-1/2): a constant-phase element.
Eigen::VectorXd HalfOrder(const Eigen::VectorXd& input, double time_constant_s);

}  // namespace zrobench::blind
