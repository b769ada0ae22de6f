// residual_rate: does the corrected gyro stay at zero? extrapolation_held: and is what is
// subtracted bounded where nothing was ever learned?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/units.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"

namespace zrobench {
namespace {

constexpr double kPiece_s = 10;

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

/// Two or three seconds say next to nothing of their own scatter: that of all pieces stands in.
class PooledScatter {
 public:
  void Add(const Piece& piece) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum_squares_[axis] += piece.sum_squares[axis];
    degrees_ += piece.n - 1;
  }
  double Uncertainty(std::size_t axis, int n) const {
    return 2 * std::sqrt(sum_squares_[axis] / degrees_ / n);
  }

 private:
  std::array<double, 3> sum_squares_{};
  int degrees_ = 0;
};

}  // namespace

CheckResult CheckResidualRate(const Expectation& expect, const CheckContext& context) {
  const double within = expect.number("within_mdps", 0);
  const int piece_s = static_cast<int>(expect.number("piece_s", kPiece_s));
  const double from = expect.number("from_degc", -HUGE_VAL);
  const double to = expect.number("to_degc", HUGE_VAL);
  CheckResult result = StartCheck(
      expect, fmt::format("corrected rate, {} s means, within {:g} mdps of zero while still and "
                          "silent",
                          piece_s, within));
  if (std::isfinite(from)) result.about += fmt::format(", {:g} to {:g} degC", from, to);
  std::array<Measurement, 3> worst;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    worst[axis] = {
        .name = fmt::format("residual_rate.{}", "xyz"[axis]), .unit = "mdps", .high = within};
  }
  PooledScatter scatter;
  Piece piece;
  for (const Second& second : context.evidence.seconds) {
    if (!second.quiet || second.mean.imu_degc < from || second.mean.imu_degc > to) {
      piece = {};
      continue;
    }
    piece.Add(second.mean);
    if (piece.n < piece_s) continue;
    KeepWorst(piece, worst);
    scatter.Add(piece);
    piece = {};
  }
  for (std::size_t axis = 0; axis < 3 && piece_s < kPiece_s; ++axis) {
    worst[axis].uncertainty_k2 = MdpsFromDps(scatter.Uncertainty(axis, piece_s));
  }
  if (worst[0].last_us != 0) result.measurements.assign(worst.begin(), worst.end());
  JudgeCheck(result);
  return result;
}

namespace {

/// Correction that was applied, as the bus shows it: raw minus corrected rate. Motion and noise are
/// in both.
class CorrectionSpread {
 public:
  explicit CorrectionSpread(std::string side) : side_(std::move(side)) {}
  void Add(const MeanItem& second) {
    if (n_++ == 0) first_us_ = second.at_us;
    last_us_ = second.at_us;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double correction_dps = second.raw_dps[axis] - second.rate_dps[axis];
      low_dps_[axis] = std::min(low_dps_[axis], correction_dps);
      high_dps_[axis] = std::max(high_dps_[axis], correction_dps);
    }
  }
  void Report(double within_mdps, std::vector<Measurement>* out) const {
    constexpr int kEnough = 10;  // seconds
    for (std::size_t axis = 0; axis < 3 && n_ >= kEnough; ++axis) {
      out->push_back({.name = fmt::format("extrapolation_held.{}.{}", side_, "xyz"[axis]),
                      .value = MdpsFromDps(high_dps_[axis] - low_dps_[axis]),
                      .unit = "mdps",
                      .high = within_mdps,
                      .first_us = first_us_,
                      .last_us = last_us_});
    }
  }

 private:
  std::string side_;
  std::array<double, 3> low_dps_ = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::array<double, 3> high_dps_ = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  std::uint64_t first_us_ = 0, last_us_ = 0;
  int n_ = 0;
};

}  // namespace

CheckResult CheckExtrapolationHeld(const Expectation& expect, const CheckContext& context) {
  const double beyond = expect.number("beyond_degc", 10), within = expect.number("within_mdps", 0);
  CheckResult result = StartCheck(
      expect, fmt::format("the correction moves by at most {:g} mdps where the board is more "
                          "than {:g} degC outside its table",
                          within, beyond));
  const auto table = FinalTable(context.evidence);
  if (!table || table->size() == 0) {
    result.reason = "the record holds no table with entries";
    return result;
  }
  CorrectionSpread below("below"), above("above");
  for (const Second& second : context.evidence.seconds) {
    if (second.mean.samples == 0) continue;
    if (second.mean.imu_degc < (*table)[0].temp_degc - beyond) below.Add(second.mean);
    if (second.mean.imu_degc > (*table)[table->size() - 1].temp_degc + beyond) {
      above.Add(second.mean);
    }
  }
  below.Report(within, &result.measurements);
  above.Report(within, &result.measurements);
  if (result.measurements.empty()) result.reason = "the board was never that far outside its table";
  JudgeCheck(result);
  return result;
}

}  // namespace zrobench
