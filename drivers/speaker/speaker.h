#pragma once
#include "core/clock.h"
#include "core/result.h"

namespace zrobench {

/// A signal generator with amplifier and transducer.
/// Implemented by VirtualSpeaker (rig/virtual); contract test: tests/contract. Thread-compatible;
/// calls return by `deadline`.
class Speaker {
 public:
  struct State {
    double hz = 0;  ///< as read back
    double v = 0;   ///< rms at the transducer; 0 when muted
    bool on = false;
  };

  virtual ~Speaker() = default;
  /// Starts (or changes) a sine of `v` volts rms and confirms frequency and level by read-back.
  virtual Status SetTone(double hz, double v, Instant deadline) = 0;
  virtual Result<State> Read(Instant deadline) = 0;
  /// Output off. Idempotent; the safe state.
  virtual Status Mute(Instant deadline) = 0;
};

}  // namespace zrobench
