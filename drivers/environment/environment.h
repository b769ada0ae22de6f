#pragma once
#include "core/clock.h"
#include "core/result.h"

namespace zrobench {

/// The air around the bench. Implemented by VirtualEnvironment (rig/virtual).
class Environment {
 public:
  struct Reading {
    double ambient_degc = 0;
    double humidity_pct = 0;
  };
  virtual ~Environment() = default;
  virtual Result<Reading> Read(Instant deadline) = 0;
};

}  // namespace zrobench
