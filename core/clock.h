#pragma once
// Every wait and every stamp goes through a Clock, so that the same controller code runs beside
// hardware (monotonic time) and on the in-process virtual rig (time that jumps to the next event).
#include <chrono>
#include <cstdint>
#include <span>

namespace zrobench {

/// Nanoseconds since the clock's start; never wall time, never negative.
using Duration = std::chrono::nanoseconds;
struct ClockTag {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<ClockTag>;
  static constexpr bool is_steady = true;
};
using Instant = ClockTag::time_point;

/// Wall time for records and dates only: nanoseconds since 1970-01-01T00:00:00Z.
using UtcNs = std::int64_t;

constexpr double ToSeconds(Duration d) { return std::chrono::duration<double>(d).count(); }
constexpr Duration FromSeconds(double s) {
  return Duration(static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5)));
}
constexpr double SecondsOf(Instant t) { return ToSeconds(t.time_since_epoch()); }

/// Something a wait can end for.
class WaitSource {
 public:
  virtual ~WaitSource() = default;
  /// True when the owner has something to take. Cheap; called after every virtual event.
  virtual bool ready() const = 0;
  /// Descriptor to poll on a real clock; -1 where there is none (in-process sources).
  virtual int fd() const { return -1; }
};

class Clock {
 public:
  virtual ~Clock() = default;
  virtual Instant now() const = 0;
  /// Wall time of now().
  virtual UtcNs utc() const = 0;
  /// The controller's only way to wait. Blocks until `deadline`, until a source is ready, or (real
  /// clock) until a signal arrives. Returns at once when a source is ready or the deadline is past.
  virtual void Wait(Instant deadline, std::span<const WaitSource* const> sources) = 0;
};

/// CLOCK_MONOTONIC, poll(2). Thread-compatible.
class RealClock final : public Clock {
 public:
  RealClock();
  Instant now() const override;
  UtcNs utc() const override;
  void Wait(Instant deadline, std::span<const WaitSource* const> sources) override;

 private:
  std::int64_t start_ns_ = 0;
};

/// What a VirtualClock moves forward: a world of discrete events.
class Simulation {
 public:
  virtual ~Simulation() = default;
  /// When the next event is due; Instant::max() for never. Not before the clock's now().
  virtual Instant next_event() const = 0;
  /// Runs the event(s) due at `t` (= next_event()).
  virtual void Run(Instant t) = 0;
};

/// Virtual time: waiting runs the simulation's events up to the deadline, in no real time.
class VirtualClock final : public Clock {
 public:
  explicit VirtualClock(UtcNs epoch) : epoch_(epoch) {}
  /// The simulation is borrowed and must outlive the clock's use. At most one.
  void Attach(Simulation* simulation) { simulation_ = simulation; }
  Instant now() const override { return now_; }
  UtcNs utc() const override { return epoch_ + now_.time_since_epoch().count() + date_shift_ns_; }
  void Wait(Instant deadline, std::span<const WaitSource* const> sources) override;
  /// Moves wall time (not the monotonic one) forward: the `date` step.
  void AdvanceDate(Duration by) { date_shift_ns_ += by.count(); }

 private:
  UtcNs epoch_;
  UtcNs date_shift_ns_ = 0;
  Instant now_{};
  Simulation* simulation_ = nullptr;
};

}  // namespace zrobench
