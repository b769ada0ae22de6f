#pragma once
#include <string>

#include "core/clock.h"
#include "core/result.h"

namespace zrobench {

/// Whoever moves the board: the virtual rig's hand, or a person who is prompted.
/// Implemented by VirtualRig (rig/virtual).
class Operator {
 public:
  virtual ~Operator() = default;
  /// Starts moving the board in the given way ("tap", "rotate", "vibrate", "hand_held") for
  /// `duration`; returns at once. kRefused when nobody can (unattended bench).
  virtual Status StartMove(const std::string& how, Duration duration) = 0;
  /// True while a move is under way.
  virtual bool moving() const = 0;
};

}  // namespace zrobench
