#pragma once
// The gyro's noise: white from its density, and flicker that is 1/f over all the time scales of a
// run, because a corrector averages over seconds and ages over hours.
#include <cstdint>
#include <vector>

#include "rig/physics/random.h"

namespace zrobench::physics {

/// Standard deviation of a sample of white noise with one-sided density `per_rthz`, seen through
/// the band 0 .. sample_hz / 2.
double WhiteSigma(double per_rthz, double sample_hz);

/// Flicker noise with one-sided S(f) = B^2 / (2 pi f) from half the sample rate down to once a day:
/// within 0.7 dB over the whole band, within 0.1 dB from 1/1000 of the sample rate down to 1/10
/// day. Below a day it levels off. The Allan deviation is flat at B sqrt(ln 2 / pi) = 0.470 B.
///
/// A bank of Ornstein-Uhlenbeck processes, time constants a factor r = 4 apart, all of variance
/// s^2 = B^2 ln r / (2 pi). Why: one process has S(f) = 4 s^2 tau / (1 + (2 pi f tau)^2); summed
/// over log-spaced tau, i.e. integrated over d(ln tau) / ln r, that is s^2 / (f ln r), free of tau.
/// The finite spacing leaves a ripple of 2 sech(pi^2 / ln r) = 0.3 %. A process of time constant
/// tau is held for up to tau / 8, so that the slow ones cost next to nothing. All start in their
/// stationary law: the noise has no turn-on transient.
class FlickerNoise {
 public:
  FlickerNoise(double b, double sample_hz, std::uint64_t seed, std::uint64_t stream);
  /// The next sample, in the unit of `b`.
  double Next() {
    double sum = held_sum_;
    for (Process& process : every_sample_) sum += process.Step(random_);
    if ((++count_ & (kRatio - 1)) == 0) StepHeld();
    return sum;
  }
  /// One-sided density that the bank truly has at `hz` in (0, sample_hz / 2], its ripple, aliases
  /// and holding included [unit of `b` squared per Hz].
  double Density(double hz) const;

 private:
  static constexpr std::uint64_t kRatio = 4;
  struct Process {
    double value, decay, kick;
    double Step(RandomStream& random) { return value = decay * value + kick * random.Normal(); }
  };
  void StepHeld();

  RandomStream random_;
  double sample_hz_;
  std::vector<Process> every_sample_;
  std::vector<Process> held_;  ///< the i-th moves every 4^(i+1) samples
  double held_sum_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace zrobench::physics
