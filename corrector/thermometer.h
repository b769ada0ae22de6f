#pragma once
// A temperature finer than a coarse sensor's step.
#include <cstdint>

namespace zro {

/// Some parts give whole degrees, or eighths. Where the value changes, the temperature is known:
/// half-way between the two. The latest three such crossings carry a parabola on, never farther
/// than the step that the sensor shows allows; without news it settles on the value shown. A sensor
/// finer than kFineDegc passes unchanged: a filter's lag would cost more than its noise.
class Thermometer {
 public:
  static constexpr float kFineDegc = 0.1f;

  explicit Thermometer(float sample_hz);

  /// The sensor's value at this sample; returns the temperature.
  float Take(float shown_degc, std::uint32_t sample);

 private:
  static constexpr int kCrossings = 3;

  void Cross(float boundary_degc, std::uint32_t sample);
  float Carried(std::uint32_t sample) const;

  float shown_degc_ = 0.0f;
  float step_degc_;                       ///< the least change seen
  float boundary_degc_[kCrossings] = {};  ///< latest first
  std::uint32_t at_[kCrossings] = {};
  std::uint32_t dither_samples_;
  std::uint8_t crossings_ = 0;
  bool started_ = false;
};

}  // namespace zro
