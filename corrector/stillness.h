#pragma once
// Is the device motionless? (US 8,577,633 B2, fig. 4: 34, 36)
#include <cstdint>

#include "corrector/types.h"

namespace zro {

/// Watches the accelerometer, and the gyro for gross rotation that it cannot see. A quiet period
/// begins when a lightly smoothed sample starts to agree with its own running mean; after
/// kDeclareS of it the device counts as motionless. Bounded time, O(1) state.
class Stillness {
 public:
  static constexpr float kDeclareS = 2.0f;  ///< quiet this long = motionless
  static constexpr float kMeanS = 2.0f;     ///< memory of the running means
  static constexpr float kLostS = 0.1f;     ///< without usable samples for longer: unknown
  static constexpr float kTurnDps = 0.5f;   ///< gyro departure that is a rotation

  /// What ended a motionless period. Value and limit: g or dps (kMotion), samples (the others).
  struct Interruption {
    Code code;  ///< kMotion, kClipped or kSampleGap
    std::uint8_t axis;
    float value;
    float limit;
  };

  explicit Stillness(float sample_hz);

  /// Takes one sample. True when it ended a declared motionless period; why: interruption().
  /// `limit_g`: accelerometer deviation that still counts as motionless.
  bool Step(const Sample& sample, float limit_g);

  bool still() const { return quiet_ >= declare_samples_; }
  /// Samples in the present quiet period; 1 on the sample that broke the one before. Counted no
  /// further than kDeclareS and kMeanS need: months of rest must not wrap it.
  std::uint32_t quiet_samples() const { return quiet_; }
  const Interruption& interruption() const { return interruption_; }

 private:
  bool Break(const Interruption& why);
  bool Lose(const Sample& sample);
  void CountQuiet();
  void Smooth(const Sample& sample);
  bool Departs(float limit_g, Interruption* why) const;

  float smooth_g_[kAxes] = {};
  float smooth_dps_[kAxes] = {};
  float mean_g_[kAxes] = {};
  float mean_dps_[kAxes] = {};
  std::uint32_t quiet_ = 0;
  std::uint32_t declare_samples_;
  std::uint32_t mean_samples_;
  std::uint32_t lost_samples_;
  std::uint32_t unusable_ = 0;  ///< consecutive samples without meaning
  bool primed_ = false;
  Interruption interruption_{};
};

/// False when a rate or an acceleration of the sample is no number or beyond any sensor.
bool IsUsable(const Sample& sample);

}  // namespace zro
