#pragma once
// Baselines, written from public descriptions: what a product does that has no corrector.
#include "tests/bench/corrector/learner.h"

namespace zrobench::bench {

/// Averages gyro and temperature over stills as the gyro alone shows them: lightly smoothed, it
/// stays within 1.72 dps of its own mean for six seconds, and below 20 dps.
class GyroStills {
 public:
  explicit GyroStills(double sample_hz) : window_(static_cast<int>(6.0 * sample_hz)) {}
  /// True when a window is full: mean and temp_degc hold it.
  bool Add(const zro::Sample& sample);
  const Vector& mean() const { return mean_; }
  double temp_degc() const { return temp_degc_; }

 private:
  int window_;
  int n_ = 0;
  Vector smooth_{};
  Vector mean_{};
  double temp_degc_ = 0.0;
};

class SimpleLearner : public Learner {
 public:
  explicit SimpleLearner(double sample_hz) : stills_(sample_hz), sample_hz_(sample_hz) {}
  void SetDate(std::uint16_t) override {}
  void TakeEvents(std::vector<zro::Event>*) override {}
  int Reboot(bool) override { return 0; }
  std::uint32_t ReadingSamples() const override {
    return static_cast<std::uint32_t>(6.0 * sample_hz_);
  }

 protected:
  GyroStills stills_;

 private:
  double sample_hz_;
};

class ConstantLearner final : public SimpleLearner {
 public:
  using SimpleLearner::SimpleLearner;
  void LoadFactory(const std::vector<std::pair<double, Vector>>&) override {}
  Vector Step(const zro::Sample& sample) override;

 private:
  Vector offset_{};
  bool known_ = false;
};

class BinsLearner final : public SimpleLearner {
 public:
  using SimpleLearner::SimpleLearner;
  void LoadFactory(const std::vector<std::pair<double, Vector>>& entries) override;
  Vector Step(const zro::Sample& sample) override;

 private:
  struct Point {
    bool known = false;
    double temp_degc = 0.0;
    Vector zro_dps{};
  };
  void Put(const Point& point);
  Vector LineAt(double temp_degc, bool* known) const;

  std::array<Point, 7> bins_;  ///< centres 10, 15 ... 40 degC
  Point latest_;
};

}  // namespace zrobench::bench
