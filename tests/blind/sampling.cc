#include "tests/blind/sampling.h"

#include <algorithm>
#include <cmath>

#include "tests/blind/thermal.h"

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd Held(const VectorXd& line, double hold_s) {
  if (hold_s <= 0) return line;
  VectorXd shown(line.size());
  for (Index row = 0; row < line.size(); ++row) {
    double sum = 0;
    for (int sub = 0; sub < kSubsteps; ++sub) {
      const double at = static_cast<double>(row) + (sub + 0.5) * kSubstep_s;
      sum += ReadAt(line, RenewedAt_s(at, hold_s)) - ReadAt(line, at);
    }
    shown[row] = line[row] + sum / kSubsteps;
  }
  return shown;
}

VectorXd Lagged(const VectorXd& line, const VectorXd& lag_s) {
  VectorXd shown(line.size());
  for (Index row = 0; row < line.size(); ++row) {
    shown[row] = ReadAt(line, static_cast<double>(row) + 0.5 - lag_s[row]);
  }
  return shown;
}

}  // namespace

double ReadAt(const VectorXd& line, double time_s) {
  const double place = std::clamp(time_s - 0.5, 0.0, static_cast<double>(line.size() - 1));
  const auto below = std::min(static_cast<Index>(place), line.size() - 2);
  const double part = place - static_cast<double>(below);
  return line[below] * (1 - part) + line[below + 1] * part;
}

VectorXd BoardLag_s(const std::vector<Effect>& effects) {
  VectorXd lag = VectorXd::Constant(kRunRows, StrengthOf(effects, "time.latency"));
  lag +=
      StrengthOf(effects, "time.clock_skew") * VectorXd::LinSpaced(kRunRows, 0.5, kRunRows - 0.5);
  const double lost_s = StrengthOf(effects, "time.drops");
  const double phase = ShapeOf(effects, "time.drops", 0);
  // Frames lost in four bursts, counted as if they were not.
  for (int burst = 0; burst < 4; ++burst) {
    const auto at = static_cast<Index>(kRunRows * (0.2 + 0.2 * burst + 0.15 * phase));
    lag.tail(kRunRows - at).array() -= lost_s / 4;
  }
  return lag;
}

double RenewedAt_s(double time_s, double hold_s) {
  return hold_s > 0 ? std::floor(time_s / hold_s) * hold_s : time_s;
}

Rows Sampled(const Rows& felt, const std::vector<Effect>& effects) {
  Rows shown = felt;
  shown.plate_degc = Held(felt.plate_degc, StrengthOf(effects, "time.sample_hold"));
  shown.die_degc = Held(felt.die_degc, StrengthOf(effects, "thermal.die_sensor_hold"));
  const VectorXd lag = BoardLag_s(effects);
  if (lag.isZero()) return shown;
  shown.die_degc = Lagged(shown.die_degc, lag);
  for (Index axis = 0; axis < 3; ++axis) {
    shown.gyro_dps.col(axis) = Lagged(felt.gyro_dps.col(axis), lag);
  }
  return shown;
}

}  // namespace zrobench::blind
