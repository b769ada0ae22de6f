#pragma once
// Estimators the noise tests judge by.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace zrobench::physics {

/// One-sided power density of `x` at `cycles` whole cycles a segment of `length` samples: Hann
/// window, segments half overlapping, the mean over `spread` neighbouring frequencies
/// (Welch 1967).
inline double Density(const std::vector<double>& x, double sample_hz, std::size_t length,
                      std::size_t cycles, std::size_t spread = 5) {
  double sum = 0, count = 0;
  for (std::size_t k = cycles; k < cycles + spread; ++k) {
    const double turn = 2 * std::numbers::pi / static_cast<double>(length);
    std::vector<double> re(length), im(length);
    for (std::size_t n = 0; n < length; ++n) {
      const double hann = 0.5 - 0.5 * std::cos(turn * static_cast<double>(n));
      const double angle = turn * static_cast<double>((k * n) % length);
      re[n] = hann * std::cos(angle);
      im[n] = hann * std::sin(angle);
    }
    for (std::size_t start = 0; start + length <= x.size(); start += length / 2) {
      double a = 0, b = 0;
      for (std::size_t n = 0; n < length; ++n) {
        a += re[n] * x[start + n];
        b += im[n] * x[start + n];
      }
      sum += a * a + b * b;
      count += 1;
    }
  }
  const double window_power = 0.375 * static_cast<double>(length);
  return 2 * sum / (count * sample_hz * window_power);
}

/// Means of `by` samples each.
inline std::vector<double> Averaged(const std::vector<double>& x, std::size_t by) {
  std::vector<double> means(x.size() / by);
  for (std::size_t i = 0; i < means.size(); ++i) {
    for (std::size_t j = 0; j < by; ++j) means[i] += x[i * by + j];
    means[i] /= static_cast<double>(by);
  }
  return means;
}

/// Allan deviation of consecutive means of `by` samples.
inline double AllanDeviation(const std::vector<double>& x, std::size_t by) {
  const std::vector<double> means = Averaged(x, by);
  double sum = 0;
  for (std::size_t i = 1; i < means.size(); ++i) {
    sum += (means[i] - means[i - 1]) * (means[i] - means[i - 1]);
  }
  return std::sqrt(sum / (2 * static_cast<double>(means.size() - 1)));
}

}  // namespace zrobench::physics
