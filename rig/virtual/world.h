#pragma once
// The virtual rig's one state and its events: heat every 0.1 s, sensors at the sample rate, frames
// to the board half a millisecond after they are sent. The drivers in virtual_rig.cc look at it and
// push its buttons.
#include <optional>

#include "core/clock.h"
#include "drivers/link/memory_bus.h"
#include "rig/physics/rig_model.h"
#include "rig/virtual/motion.h"
#include "rig/virtual/plate_controller.h"
#include "rig/virtual/virtual_board.h"

namespace zrobench {

class World final : public Simulation {
 public:
  World(const Station& station, std::uint64_t seed, physics::RigModel model, VirtualClock& clock);

  Instant next_event() const override;
  void Run(Instant t) override;

  MemoryBus& bus() { return bus_; }
  PlateController& controller() { return controller_; }
  const Station& station() const { return station_; }
  const VirtualClock& clock() const { return clock_; }

  double PlateSensor_degc() const;
  /// `band_hz`: 0 = a sine, else noise of that width about `hz`.
  void SetTone(double hz, double v, double band_hz = 0);
  double tone_hz() const { return inputs_.tone_hz; }
  double tone_band_hz() const { return inputs_.tone_band_hz; }
  double tone_v() const { return tone_v_; }
  void SetPower(bool on);
  void StartMove(MotionKind kind, Duration duration);
  bool moving() const { return move_.has_value(); }

 private:
  struct Move {
    MotionKind kind;
    Instant start;
    Duration duration;
  };

  void RunHeat();
  void RunSample(Instant t);
  void DeliverFrames();
  void UpdateMove(Instant t);
  /// The part is new at the station's epoch; a date that is advanced ages it.
  double AgeDays() const;

  Station station_;
  VirtualClock& clock_;
  physics::RigModel model_;
  physics::Inputs inputs_;
  PlateController controller_;
  MemoryBus bus_;
  VirtualBoard board_;
  Instant next_heat_{};
  double tone_v_ = 0;
  std::optional<Move> move_;
};

}  // namespace zrobench
