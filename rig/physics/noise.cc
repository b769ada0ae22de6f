#include "rig/physics/noise.h"

#include <cmath>
#include <numbers>

#include "core/check.h"

namespace zrobench::physics {
namespace {

constexpr double kDayS = 86400;
// In sample periods. Chosen so that the aliases of the fastest process fill the band up to half
// the sample rate: S(f) f stays within -0.5 .. +0.7 dB there.
constexpr double kFastestTau = 0.7;
constexpr double kHoldPerTau = 1.0 / 8;

}  // namespace

double WhiteSigma(double per_rthz, double sample_hz) { return per_rthz * std::sqrt(sample_hz / 2); }

FlickerNoise::FlickerNoise(double b, double sample_hz, std::uint64_t seed, std::uint64_t stream)
    : random_(seed, stream), sample_hz_(sample_hz) {
  ZROBENCH_CHECK(b >= 0 && sample_hz > 0);
  const double ratio = static_cast<double>(kRatio);
  const double sigma = b * std::sqrt(std::log(ratio) / (2 * std::numbers::pi));
  const auto add = [&](std::vector<Process>& bank, double step_per_tau) {
    const double decay = std::exp(-step_per_tau);
    // 1 - decay^2 without cancellation: the slow processes decay by parts in a billion.
    bank.push_back(
        {sigma * random_.Normal(), decay, sigma * std::sqrt(-std::expm1(-2 * step_per_tau))});
  };
  double hold = 1;
  for (double tau = kFastestTau; tau < ratio * kDayS * sample_hz; tau *= ratio) {
    if (hold * ratio <= tau * kHoldPerTau) hold *= ratio;
    add(hold == 1 ? every_sample_ : held_, hold / tau);
  }
  for (const Process& process : held_) held_sum_ += process.value;
}

void FlickerNoise::StepHeld() {
  std::uint64_t period = kRatio;
  held_sum_ = 0;
  for (Process& process : held_) {
    if ((count_ & (period - 1)) == 0) process.Step(random_);
    held_sum_ += process.value;
    period *= kRatio;
  }
}

double FlickerNoise::Density(double hz) const {
  const double half_turn = std::numbers::pi * hz / sample_hz_;  // of the phase, a sample
  // An autoregression of order one, each value held for `hold` samples.
  const auto one = [&](const Process& p, double hold) {
    const double swing = 2 * std::sin(half_turn * hold);
    const double level =
        p.kick * p.kick / ((1 - p.decay) * (1 - p.decay) + p.decay * swing * swing);
    const double held = std::sin(half_turn * hold) / (hold * std::sin(half_turn));
    return 2 * hold / sample_hz_ * level * held * held;
  };
  double sum = 0;
  for (const Process& process : every_sample_) sum += one(process, 1);
  double hold = 1;
  for (const Process& process : held_) sum += one(process, hold *= static_cast<double>(kRatio));
  return sum;
}

}  // namespace zrobench::physics
