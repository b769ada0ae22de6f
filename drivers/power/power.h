#pragma once
#include "core/clock.h"
#include "core/result.h"

namespace zrobench {

/// Switches the board's supply. Implemented by VirtualPower (rig/virtual).
class Power {
 public:
  virtual ~Power() = default;
  virtual Status SetOn(bool on, Instant deadline) = 0;
};

}  // namespace zrobench
