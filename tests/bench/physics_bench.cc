// What one sample of the rig costs: build/release/tests/unit/physics/physics_bench
#include <benchmark/benchmark.h>

#include "rig/physics/rig_model.h"

namespace zrobench::physics {
namespace {

void Sample(benchmark::State& state, double tone_pa) {
  Model model;
  if (tone_pa > 0) model.terms = {"acoustic.resonance", "acoustic.rectification"};
  RigModel rig = RigModel::Make(model, 200, 1).value();
  Inputs inputs;
  inputs.tone_hz = 27000;
  inputs.tone_pa = tone_pa;
  for (auto _ : state) benchmark::DoNotOptimize(rig.SampleSensors(inputs));
}

void BM_SampleSensors(benchmark::State& state) { Sample(state, 0); }
BENCHMARK(BM_SampleSensors);

void BM_SampleSensorsWithTone(benchmark::State& state) { Sample(state, 2); }
BENCHMARK(BM_SampleSensorsWithTone);

void BM_AdvanceHeat(benchmark::State& state) {
  RigModel rig = RigModel::Make(Model{}, 200, 1).value();
  Inputs inputs;
  inputs.drive_pct = 30;
  for (auto _ : state) {
    rig.AdvanceHeat(0.005, inputs);
    benchmark::DoNotOptimize(rig.temperatures());
  }
}
BENCHMARK(BM_AdvanceHeat);

}  // namespace
}  // namespace zrobench::physics
