#pragma once
// A gyro that hears: what the tests of sound begin with.
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "rig/physics/rig_model.h"

namespace zrobench::physics {

/// A gyro without noise or offset, so that what is left is the sound.
inline Model Silent(std::vector<std::string> terms) {
  Model model;
  model.gyro = GyroModel{25, 0, 0, {}};
  model.terms = std::move(terms);
  return model;
}

inline Inputs Tone(double hz, double pa) {
  Inputs inputs;
  inputs.tone_hz = hz;
  inputs.tone_pa = pa;
  return inputs;
}

/// What one axis senses over so many samples [dps].
inline std::vector<double> Record(RigModel& rig, const Inputs& inputs, int samples,
                                  std::size_t axis = 2) {
  std::vector<double> rate_dps;
  for (int i = 0; i < samples; ++i) rate_dps.push_back(rig.SampleSensors(inputs).rate_dps[axis]);
  return rate_dps;
}

inline double Mean(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

}  // namespace zrobench::physics
