#include "rig/physics/random.h"

#include <cmath>

namespace zrobench::physics {
namespace {

constexpr double kTailStart = 3.6541528853610088;      // r of 256 layers, Marsaglia and Tsang 2000
constexpr double kLayerArea = 4.92867323399130994e-3;  // v: every layer's area, the tail's included

std::uint64_t SplitMix(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

double Bell(double x) { return std::exp(-0.5 * x * x); }

}  // namespace

const RandomStream::Ziggurat& RandomStream::Layers() {
  static const Ziggurat layers = [] {
    Ziggurat z{};
    z.edge[0] = kLayerArea / Bell(kTailStart);
    z.edge[1] = kTailStart;
    for (std::size_t i = 2; i < 256; ++i) {
      z.edge[i] = std::sqrt(-2.0 * std::log(kLayerArea / z.edge[i - 1] + Bell(z.edge[i - 1])));
    }
    z.edge[256] = 0;
    for (std::size_t i = 0; i < 257; ++i) z.height[i] = Bell(z.edge[i]);
    for (std::size_t i = 0; i < 256; ++i) z.scale[i] = z.edge[i] * 0x1p-52;
    return z;
  }();
  return layers;
}

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t stream) : ziggurat_(&Layers()) {
  // The stream's number is scattered first: neighbouring (seed, stream) pairs must not collide.
  std::uint64_t state = seed ^ SplitMix(stream);
  for (std::uint64_t& word : s_) word = SplitMix(state);
}

double RandomStream::Outside(std::size_t layer, double x) {
  for (;;) {
    if (layer == 0) return Tail(x < 0);
    const double low = ziggurat_->height[layer];
    const double high = ziggurat_->height[layer + 1];
    if (low + Uniform() * (high - low) < Bell(x)) return x;
    const std::uint64_t bits = Next();
    layer = bits & 0xff;
    x = static_cast<double>(static_cast<std::int64_t>(bits) >> 11) * ziggurat_->scale[layer];
    if (std::fabs(x) < ziggurat_->edge[layer + 1]) return x;
  }
}

// Marsaglia 1964: an exponential proposal beyond the last edge.
double RandomStream::Tail(bool negative) {
  for (;;) {
    const double x = -std::log(Uniform()) / kTailStart;
    const double y = -std::log(Uniform());
    if (2 * y > x * x) return negative ? -(kTailStart + x) : kTailStart + x;
  }
}

}  // namespace zrobench::physics
