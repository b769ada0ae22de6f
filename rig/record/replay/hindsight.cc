#include "rig/record/replay/hindsight.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace zrobench {
namespace {

using Vector = std::vector<double>;

double Dot(const Vector& a, const Vector& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Takes from `v` what lies along the unit vector `q`.
void Deflate(Vector& v, const Vector& q) {
  const double along = Dot(v, q);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] -= along * q[i];
}

}  // namespace

double Hindsight::rms_mdps(std::size_t axis, int degree) const {
  const std::size_t n = degc_.size();
  if (n <= static_cast<std::size_t>(degree) + 1) return 0;
  const auto [low, high] = std::minmax_element(degc_.begin(), degc_.end());
  const double middle = (*low + *high) / 2, span = std::max(*high - *low, 1e-9);
  Vector rest = reading_dps_[axis];
  std::vector<Vector> basis;  // orthonormal over the readings (modified Gram-Schmidt)
  for (int power = 0; power <= degree; ++power) {
    Vector q(n);
    for (std::size_t i = 0; i < n; ++i) q[i] = std::pow(2 * (degc_[i] - middle) / span, power);
    for (const Vector& before : basis) Deflate(q, before);
    const double length = std::sqrt(Dot(q, q));
    if (length < 1e-9) break;  // the temperatures do not tell this power from the lower ones
    for (double& element : q) element /= length;
    Deflate(rest, q);
    basis.push_back(std::move(q));
  }
  return 1e3 * std::sqrt(Dot(rest, rest) / static_cast<double>(n));
}

}  // namespace zrobench
