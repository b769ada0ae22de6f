// residual_rate: does the corrected gyro stay at zero?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"

namespace zrobench {
namespace {

constexpr int kPieceSeconds = 10;

struct Piece {
  std::array<double, 3> mean{}, sum_squares{};
  std::uint64_t first_us = 0, last_us = 0;
  int n = 0;

  void Add(const MeanItem& second) {
    if (n++ == 0) first_us = second.at_us;
    last_us = second.at_us;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double before = second.rate_dps[axis] - mean[axis];
      mean[axis] += before / n;
      sum_squares[axis] += before * (second.rate_dps[axis] - mean[axis]);
    }
  }
  /// Expanded uncertainty of the mean from the scatter of its seconds.
  double Uncertainty(std::size_t axis) const {
    return 2 * std::sqrt(sum_squares[axis] / (n - 1) / n);
  }
};

void KeepWorst(const Piece& piece, std::array<Measurement, 3>& worst) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double value = std::abs(MdpsFromDps(piece.mean[axis]));
    if (worst[axis].last_us != 0 && value <= worst[axis].value) continue;
    worst[axis].value = value;
    worst[axis].uncertainty_k2 = MdpsFromDps(piece.Uncertainty(axis));
    worst[axis].first_us = piece.first_us;
    worst[axis].last_us = piece.last_us;
  }
}

}  // namespace

CheckResult CheckResidualRate(const Expectation& expect, const CheckContext& context) {
  const double within = expect.number("within_mdps", 0);
  CheckResult result;
  result.check = expect.check;
  result.about = fmt::format(
      "corrected rate, {} s means, within {:g} mdps of zero while still and "
      "silent",
      kPieceSeconds, within);
  std::array<Measurement, 3> worst;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    worst[axis] = {
        .name = fmt::format("residual_rate.{}", "xyz"[axis]), .unit = "mdps", .high = within};
  }
  Piece piece;
  for (const Second& second : context.evidence.seconds) {
    if (!second.quiet) {
      piece = {};
      continue;
    }
    piece.Add(second.mean);
    if (piece.n < kPieceSeconds) continue;
    KeepWorst(piece, worst);
    piece = {};
  }
  if (worst[0].last_us != 0) result.measurements.assign(worst.begin(), worst.end());
  JudgeCheck(result);
  return result;
}

}  // namespace zrobench
