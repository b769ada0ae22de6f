#pragma once
#include <cmath>
#include <numbers>

namespace zrobench::diagnose {

/// Natural logarithm of the chance that a chi-square of `dof` degrees of freedom exceeds `x`.
/// Series for the regularised incomplete gamma function below its mean, Lentz's continued fraction
/// above it (Press et al., Numerical Recipes, section 6.2), so that it neither under- nor
/// overflows.
inline double LogChiSquareTail(double x, double dof) {
  const double a = dof / 2, half = x / 2;
  if (!(half > 0)) return 0;
  const double front = a * std::log(half) - half - std::lgamma(a);
  if (half < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-15; ++n) sum += term *= half / n;
    return std::log1p(-std::exp(front) * sum);
  }
  double b = half + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int i = 1; i < 500; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= c * d;
    if (std::fabs(c * d - 1) < 1e-14) break;
  }
  return front + std::log(h);
}

}  // namespace zrobench::diagnose
