#include "tests/blind/gyro.h"

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "tests/blind/memory.h"

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// |H|^2 of one resonance, 1 at its peak.
double Gain(double hz, double resonance_hz, double q) {
  const double r = hz / resonance_hz;
  const double detuned = q * (1 - r * r);
  return 1 / (detuned * detuned + r * r);
}

// p^2 |H|^2 of each axis for the tone's `harmonic`, the resonances drifting by `ppm_per_k`.
MatrixXd TonePower(const GyroHistory& history, int harmonic, double ppm_per_k) {
  MatrixXd power = MatrixXd::Zero(kRunRows, 3);
  for (int row = 0; row < kRunRows; ++row) {
    const double pascal = TonePressure_pa(history.schedule, row);
    if (pascal == 0) continue;
    const double stretch = 1 + 1e-6 * ppm_per_k * (history.die_degc[row] - kReferenceDegc);
    for (int axis = 0; axis < 3; ++axis) {
      const double resonance = history.model.resonance_hz[static_cast<std::size_t>(axis)] * stretch;
      power(row, axis) =
          pascal * pascal *
          Gain(harmonic * history.schedule.tone_hz[row], resonance, history.model.resonance_q);
    }
  }
  return power;
}

MatrixXd Rectified(const GyroHistory& history, const MatrixXd& power) {
  const Axes& gain = history.model.rectification_dps_per_pa2;
  return power * Eigen::Vector3d(gain[0], gain[1], gain[2]).asDiagonal();
}

VectorXd Per40K(const GyroHistory& history) {
  return (history.die_degc.array() - kReferenceDegc) / 40;
}

VectorXd RatePerSecond(const VectorXd& degc) {
  VectorXd rate = VectorXd::Zero(degc.size());
  for (Index t = 1; t + 1 < degc.size(); ++t) rate[t] = 0.5 * (degc[t + 1] - degc[t - 1]);
  return rate;
}

// Seconds since power-on in the middle of each row.
VectorXd Seconds() { return VectorXd::LinSpaced(kRunRows, 0.5, kRunRows - 0.5); }

VectorXd Ageing(const GyroHistory& history, const Effect& effect) {
  const Eigen::ArrayXd hours = history.schedule.started_h + Seconds().array() / 3600;
  return (1 + hours / effect.shape[0]).log10();
}

// Kink above a temperature; 0 for the quartic.
VectorXd Curve(const GyroHistory& history, const Effect& effect) {
  if (effect.shape[0] == 0) return Per40K(history).array().pow(4);
  return (history.die_degc.array() - effect.shape[0]).max(0) / 20;
}

VectorXd StepAt(const GyroHistory& history, const Effect& effect) {
  // In the run it happens in: a power-on's own constant takes up what lasts into the next.
  const double at = (effect.shape[0] - history.run) * kRunRows;
  return at < 0 ? VectorXd(VectorXd::Zero(kRunRows))
                : VectorXd((Seconds().array() > at).cast<double>());
}

VectorXd Tilt(const GyroHistory& history, const Effect& effect) {
  const double azimuth = effect.shape[0];
  if (azimuth < 0) return history.schedule.gravity_g.col(2);
  return std::cos(azimuth) * history.schedule.gravity_g.col(0) +
         std::sin(azimuth) * history.schedule.gravity_g.col(1);
}

VectorXd Telegraph(const GyroHistory& history, const Effect& effect) {
  Draw draw(static_cast<std::uint64_t>(effect.shape[0] * 1e6), "telegraph");
  VectorXd level(kRunRows);
  double state = 1;
  for (int row = 0; row < kRunRows * (history.run + 1); ++row) {
    if (draw.Uniform(0, 1) < 1 / effect.shape[0]) state = -state;
    level[row % kRunRows] = state;
  }
  return level;
}

VectorXd PressureSquared(const GyroHistory& history) {
  VectorXd squared(kRunRows);
  for (int row = 0; row < kRunRows; ++row) {
    squared[row] = std::pow(TonePressure_pa(history.schedule, row), 2);
  }
  return squared;
}

VectorXd Supply(const GyroHistory& history) { return history.schedule.supply_v.array() - 3.3; }

using Regressor = std::function<VectorXd(const GyroHistory&, const Effect&)>;

const std::map<std::string, Regressor, std::less<>>& Regressors() {
  using H = const GyroHistory&;
  using E = const Effect&;
  static const std::map<std::string, Regressor, std::less<>> table = {
      {"gyro.backlash",
       [](H h, E e) -> VectorXd {
         return (PlayOf(h.die_degc, e.shape[0]).array() - kReferenceDegc) / 40;
       }},
      {"gyro.hysteresis", [](H h, E e) { return RelayPlane(h.die_degc, e.shape[0]); }},
      {"gyro.temperature_rate", [](H h, E) { return RatePerSecond(h.die_degc); }},
      {"gyro.creep", [](H h, E e) { return Relaxation(Per40K(h), e.shape[0], e.shape[1]); }},
      {"gyro.ageing", Ageing},
      {"gyro.warm_up", [](H, E e) -> VectorXd { return (-Seconds().array() / e.shape[0]).exp(); }},
      {"gyro.supply", [](H h, E) { return Supply(h); }},
      {"gyro.temperature_curve", Curve},
      {"gyro.step", StepAt},
      {"gyro.g_sensitivity", Tilt},
      {"gyro.vibration_rectification",
       [](H h, E) -> VectorXd { return h.schedule.vibration_g.array().square(); }},
      {"other.ripple",
       [](H h, E e) -> VectorXd { return (h.die_degc.array() * (2 * M_PI / e.shape[0])).sin(); }},
      {"other.rising_rate",
       [](H h, E) -> VectorXd {
         return RatePerSecond(h.die_degc).array().max(0) * Per40K(h).array();
       }},
      {"other.tone_temperature",
       [](H h, E) -> VectorXd { return PressureSquared(h).cwiseProduct(Per40K(h)); }},
      {"other.supply_temperature",
       [](H h, E) -> VectorXd { return Supply(h).cwiseProduct(Per40K(h)); }},
      {"other.telegraph", Telegraph},
      {"other.fractional", [](H h, E) { return HalfOrder(Per40K(h), 30); }},
  };
  return table;
}

// Effects whose shape over the axes follows from the resonances.
MatrixXd Acoustic(const GyroHistory& history, const Effect& effect) {
  if (effect.id == "acoustic.rectification") {
    const Eigen::Vector3d gain(effect.axes[0], effect.axes[1], effect.axes[2]);
    return effect.strength * TonePower(history, 1, 0) * gain.asDiagonal();
  }
  if (effect.id == "acoustic.resonance_drift") {
    return Rectified(history, TonePower(history, 1, effect.strength) - TonePower(history, 1, 0));
  }
  if (effect.id == "acoustic.harmonics") {
    return Rectified(history, effect.strength * effect.strength * TonePower(history, 3, 0));
  }
  return MatrixXd::Zero(kRunRows, 3);
}

}  // namespace

MatrixXd BaseRate_dps(const GyroHistory& history) {
  MatrixXd rate(kRunRows, 3);
  const Eigen::ArrayXd x = history.die_degc.array() - kReferenceDegc;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& b = history.model.zro_dps[axis];
    rate.col(static_cast<Index>(axis)) = b[0] + x * (b[1] + x * (b[2] + x * b[3]));
  }
  if (history.model.rectification_dps_per_pa2[2] != 0) {
    rate += Rectified(history, TonePower(history, 1, 0));
  }
  return rate;
}

MatrixXd AddedRate_dps(const GyroHistory& history, const Effect& effect) {
  const auto found = Regressors().find(effect.id);
  if (found == Regressors().end()) return Acoustic(history, effect);
  const Eigen::RowVector3d gain(effect.axes[0], effect.axes[1], effect.axes[2]);
  return effect.strength * found->second(history, effect) * gain;
}

}  // namespace zrobench::blind
