#pragma once
// Deterministic random numbers: the same seed gives the same bits in every build, which the
// distributions of <random> do not promise.
#include <array>
#include <cstdint>

namespace zrobench::physics {

/// xoshiro256++ 1.0 (Blackman and Vigna, public domain reference), seeded by splitmix64, with
/// normal variates by a ziggurat of 256 layers (Marsaglia and Tsang 2000, with Doornik's use of
/// separate bits for layer and abscissa). Streams of one seed are independent for our purposes:
/// their starting states are far apart with overwhelming probability (period 2^256).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream);

  std::uint64_t Next() {
    const std::uint64_t result = Rotate(s_[0] + s_[3], 23) + s_[0];
    const std::uint64_t t = s_[1] << 17;
    s_[2] ^= s_[0];
    s_[3] ^= s_[1];
    s_[1] ^= s_[2];
    s_[0] ^= s_[3];
    s_[2] ^= t;
    s_[3] = Rotate(s_[3], 45);
    return result;
  }
  /// Uniform in (0, 1]: its logarithm exists.
  double Uniform() { return static_cast<double>((Next() >> 11) + 1) * 0x1p-53; }
  /// Zero mean, unit variance.
  double Normal() {
    const std::uint64_t bits = Next();
    const std::size_t layer = bits & 0xff;
    // The upper 53 bits as a signed number: no branch for the sign.
    const double x =
        static_cast<double>(static_cast<std::int64_t>(bits) >> 11) * ziggurat_->scale[layer];
    const double size = x < 0 ? -x : x;
    return size < ziggurat_->edge[layer + 1] ? x : Outside(layer, x);
  }

 private:
  struct Ziggurat {
    std::array<double, 257> edge;    ///< right edges, falling; edge[0] is the base's virtual one
    std::array<double, 257> height;  ///< exp(-edge^2 / 2)
    std::array<double, 256> scale;   ///< edge / 2^52
  };
  static const Ziggurat& Layers();
  static constexpr std::uint64_t Rotate(std::uint64_t x, int k) {
    return (x << k) | (x >> (64 - k));
  }
  double Outside(std::size_t layer, double x);
  double Tail(bool negative);

  std::array<std::uint64_t, 4> s_;
  const Ziggurat* ziggurat_;
};

}  // namespace zrobench::physics
