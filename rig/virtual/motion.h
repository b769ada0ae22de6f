#pragma once
// How the virtual hand moves the board: rotation rate and acceleration as functions of time.
#include <optional>
#include <string>

#include "rig/physics/rig_model.h"

namespace zrobench {

enum class MotionKind { kTap, kRotate, kVibrate, kHandHeld };

/// "tap", "rotate", "vibrate", "hand_held"; nothing for any other word.
std::optional<MotionKind> ParseMotion(const std::string& how);

/// Sets turn_dps and shake_g of `inputs` for `t_s` seconds into a move of `duration_s`; fades in
/// and out over half a second. Rates and accelerations are a hand's (tremor 0.3-9 Hz).
void ApplyMotion(MotionKind kind, double t_s, double duration_s, physics::Inputs& inputs);

/// No motion.
void ClearMotion(physics::Inputs& inputs);

}  // namespace zrobench
