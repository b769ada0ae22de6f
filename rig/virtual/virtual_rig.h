#pragma once
// All three instruments in one process and in virtual time: physics run forward behind the same
// driver interfaces that hardware has.
#include <memory>

#include "core/clock.h"
#include "core/result.h"
#include "drivers/environment/environment.h"
#include "drivers/link/can_bus.h"
#include "drivers/operator/operator.h"
#include "drivers/plate/thermal_plate.h"
#include "drivers/power/power.h"
#include "drivers/speaker/speaker.h"
#include "rig/station/station.h"

namespace zrobench {

/// Owns the virtual world. `clock` is borrowed, is attached to, and must outlive the rig.
class VirtualRig {
 public:
  /// kConfig when the station's model is impossible. The board is powered and streams at once.
  static Result<std::unique_ptr<VirtualRig>> Make(const Station& station, std::uint64_t seed,
                                                  VirtualClock& clock);
  virtual ~VirtualRig() = default;

  virtual ThermalPlate& plate() = 0;
  virtual Speaker& speaker() = 0;
  virtual CanBus& bus() = 0;
  virtual Power& power() = 0;
  virtual Environment& environment() = 0;
  virtual Operator& hand() = 0;
};

}  // namespace zrobench
