#include "rig/virtual/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace zrobench {
namespace {

double Sine(double hz, double t_s, double phase) {
  return std::sin(2 * std::numbers::pi * hz * t_s + phase);
}

/// Knocks with a knuckle, one a second: 20 ms half-sine of 0.6 g along z and a little turn.
void Tap(double t_s, physics::Inputs& inputs) {
  constexpr double kLength_s = 0.02;
  const double into = t_s - std::floor(t_s);
  if (into > kLength_s) return;
  const double pulse = std::sin(std::numbers::pi * into / kLength_s);
  inputs.shake_g[2] = 0.6 * pulse;
  inputs.turn_dps = {6 * pulse, -4 * pulse, 0};
}

/// A turntable's crawl about gravity: the accelerometer cannot see it.
void Rotate(physics::Inputs& inputs) { inputs.turn_dps = {0, 0, 0.5}; }

/// A motor on the bench: 37 Hz, 60 mg, with some rotation through the mount.
void Vibrate(double t_s, physics::Inputs& inputs) {
  inputs.shake_g = {0.03 * Sine(37, t_s, 0.4), 0.02 * Sine(37, t_s, 1.9), 0.06 * Sine(37, t_s, 0)};
  inputs.turn_dps = {0.8 * Sine(37, t_s, 1.0), 0.5 * Sine(37, t_s, 2.0), 0.2 * Sine(37, t_s, 0.3)};
}

/// Picked up: slow swings of tens of dps with tremor on top.
void HandHeld(double t_s, physics::Inputs& inputs) {
  constexpr std::array<double, 3> kSwingHz = {0.3, 0.5, 0.7};
  constexpr std::array<double, 3> kShakeHz = {0.7, 1.0, 1.3};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double phase = 1.3 * static_cast<double>(axis);
    inputs.turn_dps[axis] = 40 * Sine(kSwingHz[axis], t_s, phase) + 2 * Sine(9, t_s, phase);
    inputs.shake_g[axis] = 0.12 * Sine(kShakeHz[axis], t_s, phase) + 0.02 * Sine(9, t_s, phase);
  }
}

}  // namespace

std::optional<MotionKind> ParseMotion(const std::string& how) {
  if (how == "tap") return MotionKind::kTap;
  if (how == "rotate") return MotionKind::kRotate;
  if (how == "vibrate") return MotionKind::kVibrate;
  if (how == "hand_held") return MotionKind::kHandHeld;
  return std::nullopt;
}

void ClearMotion(physics::Inputs& inputs) {
  inputs.turn_dps = {};
  inputs.shake_g = {};
}

void ApplyMotion(MotionKind kind, double t_s, double duration_s, physics::Inputs& inputs) {
  ClearMotion(inputs);
  switch (kind) {
    case MotionKind::kTap:
      Tap(t_s, inputs);
      break;
    case MotionKind::kRotate:
      Rotate(inputs);
      break;
    case MotionKind::kVibrate:
      Vibrate(t_s, inputs);
      break;
    case MotionKind::kHandHeld:
      HandHeld(t_s, inputs);
      break;
  }
  const double fade = std::clamp(std::min(t_s, duration_s - t_s) / 0.5, 0.0, 1.0);
  for (double& rate : inputs.turn_dps) rate *= fade;
  for (double& shake : inputs.shake_g) shake *= fade;
}

}  // namespace zrobench
