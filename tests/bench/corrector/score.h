#pragma once
// A scenario run with one seed, and its figures; many seeds, and theirs.
#include <cstdint>
#include <vector>

#include "tests/bench/corrector/learner.h"
#include "tests/bench/corrector/scenario.h"

namespace zrobench::bench {

/// Errors are of the vector, mdps.
struct Score {
  double rms_mdps = 0.0;
  double max_mdps = 0.0;
  double max_at_s = 0.0;
  int corrupt_writes = 0;  ///< window overlaps a disturbance, or off by more than 50 mdps
  int stills = 0;
  int stills_learned = 0;  ///< with a new, merged, overwrote_old or recent
  int entries_lost = 0;    ///< by the reboot or cut
  /// Stills without a disturbance after the last one of a burst, until the error was below
  /// 30 mdps; the worst burst.
  int stills_to_recover = 0;
};

/// Length of the error vector, dps.
double ErrorOf(const Vector& estimate_dps, const Vector& truth_dps);

/// What is told of each sample and event, for a closer look; may be null.
struct Watcher {
  virtual ~Watcher() = default;
  virtual void OnSample(const Instant& instant, const Vector& estimate_dps) = 0;
  virtual void OnEvent(const Instant& instant, const zro::Event& event) = 0;
};

Score Run(const Scenario& scenario, LearnerKind kind, std::uint64_t seed,
          Watcher* watcher = nullptr);

struct Summary {
  double rms_mdps = 0.0;   ///< median over the seeds
  double max_mdps = 0.0;   ///< 90th percentile
  int corrupt_writes = 0;  ///< of all seeds together
  int stills = 0, stills_learned = 0;
  int entries_lost = 0;       ///< the most
  int stills_to_recover = 0;  ///< the most
};
Summary Summarise(const std::vector<Score>& scores);

}  // namespace zrobench::bench
