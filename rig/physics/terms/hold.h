#pragma once
// A register that is filled now and then, and holds its value in between.
#include <cmath>
#include <cstddef>
#include <span>

#include "rig/physics/term.h"

namespace zrobench::physics {

/// States: the held value; for how long it has been held [s]; what was there to read at the end of
/// the last step.
inline constexpr std::size_t kHoldStates = 3;

inline void PlaceHold(double value, std::span<double> states) {
  states[0] = states[2] = value;
  states[1] = 0;
}

/// What the register shows at the end of a step of `dt_s`, over which its input moved in a straight
/// line; it is read at the multiples of `hold_s`, whatever the steps. 0 holds nothing.
inline double HeldValue(double input, double hold_s, double dt_s, std::span<double> states) {
  if (hold_s <= 0 || dt_s <= 0) return input;
  constexpr double kRounding_s = 1e-9;  // of many steps' sum
  const double held_s = states[1] + dt_s;
  states[1] = held_s;
  if (held_s >= hold_s - kRounding_s) {
    const double since_s = std::fmod(held_s + kRounding_s, hold_s) - kRounding_s;
    states[1] = since_s > kRounding_s ? since_s : 0;
    states[0] = input + (states[2] - input) * states[1] / dt_s;
  }
  states[2] = input;
  return states[0];
}

/// The register that one sensor is read through; its one parameter is hold_s.
template <double Temperatures::*kSensor>
class HeldRegister final : public Term {
 public:
  void Place(const Temperatures& at, std::span<double> states) const override {
    PlaceHold(at.*kSensor, states);
  }
  void Show(const HeatContext& context, std::span<const double> parameters,
            std::span<double> states, Temperatures& shown) const override {
    shown.*kSensor = HeldValue(shown.*kSensor, parameters[0], context.dt_s, states);
  }
};

}  // namespace zrobench::physics
