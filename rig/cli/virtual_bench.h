#pragma once
#include <memory>

#include "rig/run/run.h"
#include "rig/virtual/virtual_rig.h"

namespace zrobench {

/// The in-process virtual rig with its clock, as the instruments of a run.
class VirtualBench {
 public:
  /// kConfig when the station's model is impossible.
  static Result<std::unique_ptr<VirtualBench>> Make(const Station& station, std::uint64_t seed) {
    auto bench = std::unique_ptr<VirtualBench>(new VirtualBench(station.virtual_rig.epoch));
    auto rig = VirtualRig::Make(station, seed, bench->clock_);
    if (!rig) return tl::unexpected(rig.error());
    bench->rig_ = std::move(*rig);
    return bench;
  }
  Instruments instruments() {
    return {{clock_, rig_->plate(), rig_->speaker(), &rig_->power(), &rig_->environment(),
             &rig_->hand(), [this](Duration by) { clock_.AdvanceDate(by); }},
            rig_->bus()};
  }

 private:
  explicit VirtualBench(UtcNs epoch) : clock_(epoch) {}
  VirtualClock clock_;
  std::unique_ptr<VirtualRig> rig_;
};

}  // namespace zrobench
