#include "tests/bench/corrector/simple_learners.h"

#include <algorithm>
#include <cmath>

namespace zrobench::bench {
namespace {

constexpr double kSmoothing = 0.4;
constexpr double kWanderDps = 1.72;
constexpr double kMostDps = 20.0;

}  // namespace

bool GyroStills::Add(const zro::Sample& sample) {
  bool quiet = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const double rate = static_cast<double>(sample.rate_dps[i]);
    if (!std::isfinite(rate)) return false;
    smooth_[i] += kSmoothing * (rate - smooth_[i]);
    quiet = quiet && std::abs(smooth_[i]) < kMostDps &&
            (n_ == 0 || std::abs(smooth_[i] - mean_[i]) < kWanderDps);
  }
  if (!quiet || n_ == window_) n_ = 0;
  if (!quiet) return false;
  ++n_;
  for (std::size_t i = 0; i < 3; ++i) {
    if (n_ == 1) mean_[i] = 0.0;
    mean_[i] += (static_cast<double>(sample.rate_dps[i]) - mean_[i]) / n_;
  }
  if (n_ == 1) temp_degc_ = 0.0;
  temp_degc_ += (static_cast<double>(sample.temp_degc) - temp_degc_) / n_;
  return n_ == window_;
}

Vector ConstantLearner::Step(const zro::Sample& sample) {
  if (stills_.Add(sample) && !known_) {
    known_ = true;
    offset_ = stills_.mean();
  }
  return offset_;
}

void BinsLearner::Put(const Point& point) {
  const double bin = std::round((point.temp_degc - 10.0) / 5.0);
  const auto index = static_cast<std::size_t>(std::clamp(bin, 0.0, 6.0));
  const double centre = 10.0 + 5.0 * static_cast<double>(index);
  Point& held = bins_[index];
  if (held.known && std::abs(held.temp_degc - centre) <= std::abs(point.temp_degc - centre)) {
    return;
  }
  held = point;
}

void BinsLearner::LoadFactory(const std::vector<std::pair<double, Vector>>& entries) {
  for (const auto& [degc, zro] : entries) Put({true, degc, zro});
}

Vector BinsLearner::LineAt(double temp_degc, bool* known) const {
  const Point* first = nullptr;
  const Point* second = nullptr;
  const auto farther = [temp_degc](const Point* a, const Point& b) {
    return a == nullptr || std::abs(b.temp_degc - temp_degc) < std::abs(a->temp_degc - temp_degc);
  };
  for (const Point& p : bins_) {
    if (p.known && farther(first, p)) first = &p;
  }
  *known = first != nullptr;
  if (first == nullptr) return {};
  for (const Point& p : bins_) {
    if (p.known && std::abs(p.temp_degc - first->temp_degc) > 1.0 && farther(second, p)) {
      second = &p;
    }
  }
  Vector at = first->zro_dps;
  if (second == nullptr) return at;
  const double share = (temp_degc - first->temp_degc) / (second->temp_degc - first->temp_degc);
  for (std::size_t i = 0; i < 3; ++i) at[i] += share * (second->zro_dps[i] - first->zro_dps[i]);
  return at;
}

Vector BinsLearner::Step(const zro::Sample& sample) {
  const double degc = static_cast<double>(sample.temp_degc);
  if (stills_.Add(sample)) {
    latest_ = {true, stills_.temp_degc(), stills_.mean()};
    Put(latest_);
  }
  bool known = false;
  Vector at = LineAt(degc, &known);
  if (!latest_.known || std::abs(degc - latest_.temp_degc) > 2.5) return at;
  const Vector there = LineAt(latest_.temp_degc, &known);
  for (std::size_t i = 0; i < 3; ++i) at[i] += latest_.zro_dps[i] - there[i];
  return at;
}

}  // namespace zrobench::bench
