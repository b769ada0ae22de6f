#include "tests/blind/pink.h"

#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace zrobench::blind {

Eigen::VectorXd PinkNoise(Draw& draw, int rows, double flicker) {
  std::size_t length = 2;
  while (length < 2 * static_cast<std::size_t>(rows)) length *= 2;
  const double bin_hz = 1.0 / static_cast<double>(length);
  std::vector<std::complex<double>> spectrum(length);
  for (std::size_t k = 1; k <= length / 2; ++k) {
    const double density = flicker * flicker / (2 * M_PI * static_cast<double>(k) * bin_hz);
    // Each line carries density * bin_hz of variance, half of it on the negative side.
    const double amplitude = static_cast<double>(length) * std::sqrt(density * bin_hz) / 2;
    const std::complex<double> line(draw.Normal(amplitude), draw.Normal(amplitude));
    spectrum[k] = k == length / 2 ? std::complex<double>(line.real() * std::sqrt(2.0)) : line;
    spectrum[length - k] = std::conj(spectrum[k]);
  }
  std::vector<std::complex<double>> series;
  Eigen::FFT<double> transform;
  transform.inv(series, spectrum);
  Eigen::VectorXd noise(rows);
  for (int i = 0; i < rows; ++i) noise[i] = series[static_cast<std::size_t>(i)].real();
  return noise;
}

}  // namespace zrobench::blind
