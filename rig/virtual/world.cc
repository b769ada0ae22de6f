#include "rig/virtual/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rig/physics/sensor_word.h"

namespace zrobench {
namespace {

constexpr auto kHeatStep = std::chrono::milliseconds(100);  ///< also the plate's control period
constexpr auto kBusDelay =
    std::chrono::microseconds(500);  ///< a frame on the wire and its handling

}  // namespace

World::World(const Station& station, std::uint64_t seed, physics::RigModel model,
             VirtualClock& clock)
    : station_(station),
      clock_(clock),
      model_(std::move(model)),
      controller_(station.virtual_rig),
      bus_(clock),
      board_(station, seed, bus_.board_sink()),
      next_heat_(clock.now() + kHeatStep) {
  board_.PowerOn(clock.now());
}

Instant World::next_event() const {
  const Instant due = std::min(next_heat_, board_.next_sample());
  return bus_.board_pending() ? std::min(due, clock_.now() + kBusDelay) : due;
}

void World::Run(Instant t) {
  DeliverFrames();  // first: the bus's order is the order in which the board sees things
  if (next_heat_ <= t) RunHeat();
  if (board_.next_sample() <= t) RunSample(t);
}

void World::RunHeat() {
  const double dt_s = ToSeconds(kHeatStep);
  inputs_.drive_pct = controller_.Step(PlateSensor_degc(), dt_s);
  inputs_.powered = board_.on();
  inputs_.load_pct = board_.load_pct();
  model_.AdvanceHeat(dt_s, inputs_);
  next_heat_ += kHeatStep;
}

void World::RunSample(Instant t) {
  if (move_) UpdateMove(t);
  inputs_.age_days = AgeDays();
  board_.Sample(model_.SampleSensors(inputs_), model_.shown_temperatures().die_degc);
}

double World::AgeDays() const {
  constexpr double kDay_ns = 86400e9;
  return static_cast<double>(clock_.utc() - station_.virtual_rig.epoch) / kDay_ns;
}

void World::UpdateMove(Instant t) {
  if (t >= move_->start + move_->duration) {
    ClearMotion(inputs_);
    move_.reset();
    return;
  }
  ApplyMotion(move_->kind, ToSeconds(t - move_->start), ToSeconds(move_->duration), inputs_);
}

void World::DeliverFrames() {
  while (const auto frame = bus_.BoardReceive()) board_.Deliver(*frame);
}

double World::PlateSensor_degc() const {
  return physics::Quantise(model_.shown_temperatures().plate_degc,
                           station_.model.plate.resolution_degc);
}

void World::SetTone(double hz, double v, double band_hz) {
  tone_v_ = v;
  inputs_.tone_hz = hz;
  inputs_.tone_band_hz = band_hz;
  inputs_.tone_pa = v * station_.model.speaker.pa_per_v;
}

void World::SetPower(bool on) {
  if (on == board_.on()) return;
  if (!on) {
    board_.PowerOff();
    return;
  }
  model_.PowerCycle();
  board_.PowerOn(clock_.now());
}

void World::StartMove(MotionKind kind, Duration duration) {
  move_ = Move{kind, clock_.now(), duration};
}

}  // namespace zrobench
