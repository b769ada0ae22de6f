#pragma once
#include <optional>
#include <vector>

#include "rig/record/replay/replay_input.h"

namespace zrobench {

/// Noise density of a recording's gyro [dps/sqrt(Hz), one-sided, worst axis] from its first 5 s
/// without motion, gaps or clipping; nothing where there are none within the first 10 minutes.
/// Standard deviation about the mean, taken as white up to half the sample rate.
class NoiseSurvey final : public ReplaySink {
 public:
  explicit NoiseSurvey(double sample_hz, float still_sigma_g);
  bool OnSample(double t_s, const zro::Sample& sample) override;
  void OnDate(std::uint16_t) override {}
  void OnBoot() override { window_.clear(); }
  void OnStore() override {}
  std::optional<float> density_dps_per_rthz() const { return density_; }

 private:
  bool Still() const;
  float Density() const;

  double sample_hz_;
  float still_sigma_g_;
  std::size_t wanted_;
  std::vector<zro::Sample> window_;
  std::optional<double> began_s_;
  std::optional<float> density_;
};

}  // namespace zrobench
