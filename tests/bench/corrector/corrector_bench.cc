// What a sample costs the host, beside a loop that only averages and subtracts:
//   build/release/tests/bench/corrector/corrector_bench_ns
#include <benchmark/benchmark.h>

#include <vector>

#include "corrector/corrector.h"
#include "tests/bench/corrector/world.h"

namespace zrobench::bench {
namespace {

/// Ten minutes of the scenario `cycle`.
const std::vector<zro::Sample>& Samples() {
  static const std::vector<zro::Sample> kSamples = [] {
    World world(FindScenario("cycle"), 1);
    std::vector<zro::Sample> samples;
    for (Instant now; samples.size() < 60000 && world.Next(&now);) samples.push_back(now.sample);
    return samples;
  }();
  return kSamples;
}

void BM_Corrector(benchmark::State& state) {
  const auto& samples = Samples();
  zro::Corrector corrector(zro::ConfigFor(100.0f, 0.005f), nullptr);
  for (const auto& [degc, zro] : FactoryOf(FindScenario("cycle"), 1)) {
    const float zro_dps[3] = {static_cast<float>(zro[0]), static_cast<float>(zro[1]),
                              static_cast<float>(zro[2])};
    corrector.AddFactoryEntry(static_cast<float>(degc), zro_dps, 0.01f);
  }
  std::size_t i = 0;
  zro::Event event;
  for (auto _ : state) {
    benchmark::DoNotOptimize(corrector.Step(samples[i]));
    while (corrector.PopEvent(&event)) {
    }
    if (++i == samples.size()) i = 0;
  }
}
BENCHMARK(BM_Corrector);

/// Running mean and variance of six channels and a subtraction: what any still detector does.
void BM_Reference(benchmark::State& state) {
  const auto& samples = Samples();
  float mean[6] = {}, variance[6] = {};
  std::size_t i = 0;
  for (auto _ : state) {
    const zro::Sample& s = samples[i];
    float rate[3];
    for (int k = 0; k < 6; ++k) {
      const float x = k < 3 ? s.rate_dps[k] : s.accel_g[k - 3];
      const float d = x - mean[k];
      mean[k] += 0.01f * d;
      variance[k] += 0.01f * (d * (x - mean[k]) - variance[k]);
    }
    for (int k = 0; k < 3; ++k) rate[k] = s.rate_dps[k] - mean[k];
    benchmark::DoNotOptimize(rate);
    benchmark::DoNotOptimize(variance);
    if (++i == samples.size()) i = 0;
  }
}
BENCHMARK(BM_Reference);

}  // namespace
}  // namespace zrobench::bench
