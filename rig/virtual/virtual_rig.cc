#include "rig/virtual/virtual_rig.h"

#include <fmt/format.h>

#include <utility>

#include "rig/virtual/world.h"

namespace zrobench {
namespace {

class VirtualPlate final : public ThermalPlate {
 public:
  explicit VirtualPlate(World& world) : world_(world) {}

  Result<Reading> Read(Instant) override {
    const PlateController& controller = world_.controller();
    return Reading{world_.PlateSensor_degc(), controller.setpoint_degc(), controller.drive_pct(),
                   world_.clock().now()};
  }
  Status SetTarget(double degc, Instant) override {
    const StationLimits& limits = world_.station().limits;
    if (!(degc >= limits.min_degc && degc <= limits.max_degc)) {
      return Fail(Error::Kind::kLimit,
                  fmt::format("plate: set point {} degC is outside {}..{} degC", degc,
                              limits.min_degc, limits.max_degc));
    }
    world_.controller().Start(degc, world_.PlateSensor_degc());
    return {};
  }
  Status MakeSafe(Instant) override {
    world_.controller().Stop();
    return {};
  }

 private:
  World& world_;
};

class VirtualSpeaker final : public Speaker {
 public:
  explicit VirtualSpeaker(World& world) : world_(world) {}

  Status SetTone(double hz, double v, Instant) override {
    if (!Allowed(hz, v)) {
      return Fail(Error::Kind::kLimit,
                  fmt::format("speaker: {} Hz at {} V is outside its limits", hz, v));
    }
    world_.SetTone(hz, v);
    return {};
  }
  bool plays_music() const override { return true; }
  Status SetMusic(double low_hz, double high_hz, double v, Instant) override {
    if (!Allowed(low_hz, v) || !Allowed(high_hz, v) || !(low_hz < high_hz)) {
      return Fail(Error::Kind::kLimit, fmt::format("speaker: {} to {} Hz at {} V is outside its "
                                                   "limits",
                                                   low_hz, high_hz, v));
    }
    world_.SetTone((low_hz + high_hz) / 2, v, high_hz - low_hz);
    return {};
  }
  Result<State> Read(Instant) override {
    return State{world_.tone_hz(), world_.tone_v(), world_.tone_v() > 0, world_.tone_band_hz()};
  }
  Status Mute(Instant) override {
    world_.SetTone(0, 0);
    return {};
  }

 private:
  bool Allowed(double hz, double v) const {
    const StationLimits& limits = world_.station().limits;
    return hz >= limits.min_tone_hz && hz <= limits.max_tone_hz && v >= 0 && v <= limits.max_tone_v;
  }

  World& world_;
};

class VirtualPower final : public Power {
 public:
  explicit VirtualPower(World& world) : world_(world) {}
  Status SetOn(bool on, Instant) override {
    world_.SetPower(on);
    return {};
  }

 private:
  World& world_;
};

class VirtualEnvironment final : public Environment {
 public:
  explicit VirtualEnvironment(World& world) : world_(world) {}
  Result<Reading> Read(Instant) override {
    return Reading{world_.station().model.ambient_degc, world_.station().humidity_pct};
  }

 private:
  World& world_;
};

class VirtualHand final : public Operator {
 public:
  explicit VirtualHand(World& world) : world_(world) {}
  Status StartMove(const std::string& how, Duration duration) override {
    const auto kind = ParseMotion(how);
    if (!kind) return Fail(Error::Kind::kRefused, "the virtual hand knows no move '" + how + "'");
    world_.StartMove(*kind, duration);
    return {};
  }
  bool moving() const override { return world_.moving(); }

 private:
  World& world_;
};

class InProcessRig final : public VirtualRig {
 public:
  InProcessRig(const Station& station, std::uint64_t seed, physics::RigModel model,
               VirtualClock& clock)
      : world_(station, seed, std::move(model), clock) {
    clock.Attach(&world_);
  }
  ThermalPlate& plate() override { return plate_; }
  Speaker& speaker() override { return speaker_; }
  CanBus& bus() override { return world_.bus(); }
  Power& power() override { return power_; }
  Environment& environment() override { return environment_; }
  Operator& hand() override { return hand_; }

 private:
  World world_;
  VirtualPlate plate_{world_};
  VirtualSpeaker speaker_{world_};
  VirtualPower power_{world_};
  VirtualEnvironment environment_{world_};
  VirtualHand hand_{world_};
};

}  // namespace

Result<std::unique_ptr<VirtualRig>> VirtualRig::Make(const Station& station, std::uint64_t seed,
                                                     VirtualClock& clock) {
  auto model = physics::RigModel::Make(station.model, station.virtual_rig.sample_hz, seed);
  if (!model) return tl::unexpected(model.error());
  return std::make_unique<InProcessRig>(station, seed, std::move(*model), clock);
}

}  // namespace zrobench
