#include "rig/run/reference.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace zrobench {
namespace {

constexpr double kHalfWidth_degc = 1.0;
constexpr int kBlockSeconds = 5;
constexpr std::size_t kMinBlocks = 4;

struct Block {
  double degc = 0;
  std::array<double, 3> zro{};
};

/// Two-sided 95 % quantile of Student's t, within 3 % from 2 degrees of freedom on.
double StudentT95(std::size_t dof) {
  const double n = static_cast<double>(dof);
  return dof <= 1 ? 12.71 : 1.96 + 2.4 / n + 4.7 / (n * n) + (dof == 2 ? -0.03 : 0.0);
}

std::vector<Block> BlocksNear(std::span<const Second> seconds, double degc, Reference& reference) {
  std::vector<Block> blocks;
  Block open;
  int n = 0;
  for (const Second& second : seconds) {
    const bool use = second.quiet && std::abs(second.mean.imu_degc - degc) <= kHalfWidth_degc;
    if (!use) {
      n = 0;
      open = {};
      continue;
    }
    open.degc += second.mean.imu_degc / kBlockSeconds;
    for (std::size_t a = 0; a < 3; ++a) open.zro[a] += second.mean.raw_dps[a] / kBlockSeconds;
    if (++n < kBlockSeconds) continue;
    blocks.push_back(open);
    if (reference.first_us == 0) reference.first_us = second.mean.at_us;
    reference.last_us = second.mean.at_us;
    n = 0;
    open = {};
  }
  return blocks;
}

struct Line {
  double value = 0, uncertainty_k2 = 0;
};

/// Value at x = 0 of the least-squares line, with its expanded uncertainty.
Line FitAtZero(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double mx = 0, my = 0, sxx = 0, sxy = 0, rss = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - mx) * (x[i] - mx);
    sxy += (x[i] - mx) * (y[i] - my);
  }
  // On a soak the temperature hardly moves and a slope would only be noise.
  // A few blocks of a ramp beside a long soak are enough: all lie on one line, at their own x.
  constexpr double kMinSquares_degc2 = 0.1;
  const bool sloped = sxx > kMinSquares_degc2;
  const double slope = sloped ? sxy / sxx : 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = y[i] - my - slope * (x[i] - mx);
    rss += r * r;
  }
  const std::size_t dof = x.size() - (sloped ? 2 : 1);
  const double s2 = rss / static_cast<double>(dof);
  const double variance = s2 * (1 / n + (sloped ? mx * mx / sxx : 0));
  return {my - slope * mx, StudentT95(dof) * std::sqrt(variance)};
}

}  // namespace

std::optional<Reference> ReferenceAt(std::span<const Second> seconds, double degc) {
  Reference reference;
  const std::vector<Block> blocks = BlocksNear(seconds, degc, reference);
  if (blocks.size() < kMinBlocks) return std::nullopt;
  std::vector<double> x, y(blocks.size());
  for (const Block& block : blocks) x.push_back(block.degc - degc);
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  constexpr double kReach_degc = 0.3;  ///< how far beyond the data a value may be read off
  if (*low > kReach_degc || *high < -kReach_degc) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < blocks.size(); ++i) y[i] = blocks[i].zro[axis];
    const Line line = FitAtZero(x, y);
    reference.zro_dps[axis] = line.value;
    reference.uncertainty_k2_dps[axis] = line.uncertainty_k2;
  }
  return reference;
}

}  // namespace zrobench
