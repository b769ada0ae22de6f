#pragma once
// The instruments of one station, as the controller sees them.
#include <functional>

#include "core/clock.h"
#include "drivers/environment/environment.h"
#include "drivers/imu/imu_board.h"
#include "drivers/operator/operator.h"
#include "drivers/plate/thermal_plate.h"
#include "drivers/power/power.h"
#include "drivers/speaker/speaker.h"

namespace zrobench {

/// What stands around the board, all borrowed. `power`, `environment` and `hand` may be null where
/// a bench has none.
struct Apparatus {
  Clock& clock;
  ThermalPlate& plate;
  Speaker& speaker;
  Power* power = nullptr;
  Environment* environment = nullptr;
  Operator* hand = nullptr;
  /// Moves wall time on; empty where the date is the real one.
  std::function<void(Duration)> advance_date = {};
};

struct Bench : Apparatus {
  ImuBoard& board;  ///< borrowed
};

/// Makes the bench safe: speaker muted first, then the plate off, then the board's supply on: it
/// stays readable. Tries everything even when one step fails; returns the first failure.
Status MakeSafe(Bench& bench);

}  // namespace zrobench
