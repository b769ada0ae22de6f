#pragma once
// What most effects on the gyro share: one cause, and on each axis a strength of its own.
#include "rig/physics/term.h"

namespace zrobench::physics {

/// rate[axis] += parameters[axis] * Cause(...): its first three parameters are the coefficients.
class PerAxisTerm : public Term {
 public:
  void Output(const TermContext& context, std::span<const double> parameters,
              std::span<const double> states, Sensed& sensed) const final {
    const double cause = Cause(context, parameters, states);
    for (std::size_t axis = 0; axis < 3; ++axis) sensed.rate_dps[axis] += parameters[axis] * cause;
  }

 protected:
  /// Finite even before the first Step of a power-on.
  virtual double Cause(const TermContext& context, std::span<const double> parameters,
                       std::span<const double> states) const = 0;
};

}  // namespace zrobench::physics
