#pragma once
// Random draws of the concealed-effect benchmark: one stream a purpose, so that a class's choices
// never shift another's.
#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

namespace zrobench::blind {

/// The same seed and purpose give the same draws on one C++ library.
class Draw {
 public:
  Draw(std::uint64_t seed, std::string_view purpose) {
    std::seed_seq words(purpose.begin(), purpose.end());
    std::uint32_t mix[2];
    words.generate(mix, mix + 2);
    std::seed_seq both{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                       mix[0], mix[1]};
    engine_.seed(both);
  }

  double Uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  double Normal(double sigma = 1) { return sigma * normal_(engine_); }
  /// 0 ... count - 1.
  int Below(int count) { return static_cast<int>(Uniform(0, count)); }
  double Sign() { return Uniform(0, 1) < 0.5 ? -1 : 1; }
  std::uint64_t Bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace zrobench::blind
