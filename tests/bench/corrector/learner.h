#pragma once
// What is measured: the corrector, and two simple ways of doing without it.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "corrector/types.h"
#include "tests/bench/corrector/world.h"

namespace zrobench::bench {

/// Something that learns offsets from samples. One object a run; reboots are its own affair.
class Learner {
 public:
  virtual ~Learner() = default;
  virtual void LoadFactory(const std::vector<std::pair<double, Vector>>& entries) = 0;
  virtual void SetDate(std::uint16_t days) = 0;
  /// The offset held at this sample, dps.
  virtual Vector Step(const zro::Sample& sample) = 0;
  /// Decisions since the last call, appended; none from learners that keep no log.
  virtual void TakeEvents(std::vector<zro::Event>* out) = 0;
  /// `orderly`: what is not yet stored is stored first. Returns the entries lost.
  virtual int Reboot(bool orderly) = 0;
  /// Samples of one reading, from its first to its last.
  virtual std::uint32_t ReadingSamples() const = 0;
};

enum class LearnerKind {
  kOurs,
  kConstant,  ///< the mean of the first still, for good
  kBins,      ///< bins of 5 degC, a point replaces one farther from the bin's centre; line through
          ///< the two nearest, moved to the latest point (after Rift DK1 as described in public)
};

std::unique_ptr<Learner> MakeLearner(LearnerKind kind, double sample_hz);

}  // namespace zrobench::bench
