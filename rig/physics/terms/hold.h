#pragma once
// A register that is filled now and then, and holds its value in between.
#include <cmath>
#include <cstddef>
#include <span>

namespace zrobench::physics {

/// States: the held value, and for how long it has been held [s].
inline constexpr std::size_t kHoldStates = 2;

/// What the register shows at the end of a step of `dt_s`; 0 holds nothing.
inline double HeldValue(double input, double hold_s, double dt_s, std::span<double> states) {
  if (hold_s <= 0) return input;
  states[1] += dt_s;
  constexpr double kRounding_s = 1e-9;  // of many steps' sum
  if (states[1] >= hold_s - kRounding_s) {
    states[0] = input;
    states[1] = std::fmod(states[1] + kRounding_s, hold_s);
  }
  return states[0];
}

}  // namespace zrobench::physics
