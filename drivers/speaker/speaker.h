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
    double band_hz = 0;  ///< 0 = a sine; else noise of that width about hz
  };

  virtual ~Speaker() = default;
  /// Starts (or changes) a sine of `v` volts rms and confirms frequency and level by read-back.
  virtual Status SetTone(double hz, double v, Instant deadline) = 0;
  /// Whether it can play noise in a band: many generators know sines only.
  virtual bool plays_music() const { return false; }
  /// Starts (or changes) noise, flat from `low_hz` to `high_hz`, of `v` volts rms. kRefused where
  /// plays_music() is false.
  virtual Status SetMusic(double low_hz, double high_hz, double v, Instant deadline);
  virtual Result<State> Read(Instant deadline) = 0;
  /// Output off. Idempotent; the safe state.
  virtual Status Mute(Instant deadline) = 0;
};

inline Status Speaker::SetMusic(double, double, double, Instant) {
  return Fail(Error::Kind::kRefused, "speaker: this generator knows sines only");
}

}  // namespace zrobench
