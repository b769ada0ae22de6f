#include "rig/run/bench_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rig/profile/dew_point.h"
#include "rig/run/evidence.h"

namespace zrobench {
namespace {

constexpr auto kTick = std::chrono::milliseconds(100);
constexpr auto kPlateDeadline = std::chrono::seconds(2);
/// A table of 48 entries is some 170 SDO segments: half a second. While we wait nobody watches the
/// plate, so not much longer.
constexpr auto kBoardDeadline = std::chrono::seconds(3);
constexpr auto kDecisionPeriod = std::chrono::seconds(5);
constexpr auto kSnapshotPeriod = std::chrono::minutes(1);
/// Beyond the 1.5 s after which the driver calls the board dead: 2 s without a frame in all.
constexpr auto kSilenceLimit = std::chrono::milliseconds(500);
constexpr double kTripMargin_degc = 10;  ///< process value beyond the set-point limits: trip

Flow FromStatus(const Status& status) {
  if (status) return {};
  return Stop(Halt::Why::kRigFault, status.error().message);
}

}  // namespace

BenchLoop::BenchLoop(Bench& bench, const Station& station, RunLog& log, const StopRequest& stop)
    : bench_(bench),
      station_(station),
      log_(log),
      stop_(stop),
      stimuli_(bench, log),
      next_second_(bench.clock.now()),
      next_decisions_(bench.clock.now() + kDecisionPeriod),
      last_alive_(bench.clock.now()),
      next_snapshot_(bench.clock.now() + kSnapshotPeriod),
      last_utc_(bench.clock.utc()) {}

Flow BenchLoop::RunUntil(Instant until) {
  while (now() < until) {
    if (auto flow = Tick(); !flow) return flow;
  }
  return {};
}

Flow BenchLoop::Tick() {
  if (auto flow = CheckStop(); !flow) return flow;
  bench_.clock.Wait(std::min(now() + kTick, std::max(next_second_, now())), {});
  if (auto flow = FromStatus(bench_.board.Pump()); !flow) return flow;
  if (now() >= next_second_) {
    if (auto flow = EverySecond(); !flow) return flow;
  }
  if (auto flow = FromStatus(stimuli_.Update(board_degc())); !flow) return flow;
  if (now() >= next_decisions_ && !silence_expected_) return ReadDecisions();
  return {};
}

Flow BenchLoop::EverySecond() {
  next_second_ += std::chrono::seconds(1);
  if (auto flow = FollowRamp(); !flow) return flow;
  const auto reading = bench_.plate.Read(now() + kPlateDeadline);
  if (!reading) return Stop(Halt::Why::kRigFault, reading.error().message);
  plate_ = *reading;
  log_.Write(PlateItem{log_.now_us(), plate_.setpoint_degc, plate_.process_degc, plate_.drive_pct,
                       ReadAir()});
  if (now() >= next_snapshot_) {
    next_snapshot_ += kSnapshotPeriod;
    log_.WriteSnapshot();
  }
  if (auto flow = FromStatus(bench_.board.SendHeartbeat()); !flow) return flow;
  return Watch();
}

Flow BenchLoop::Watch() {
  if (const Status record = log_.recorder().Flush(); !record) {
    return Stop(Halt::Why::kRigFault, record.error().message);
  }
  WatchBoots();
  WatchWallTime();
  if (!std::isfinite(plate_.process_degc) ||
      plate_.process_degc > station_.limits.max_degc + kTripMargin_degc ||
      plate_.process_degc < station_.limits.min_degc - kTripMargin_degc) {
    return Stop(
        Halt::Why::kSafetyTrip,
        fmt::format("plate reads {:.1f} degC, limits are {} .. {} degC", plate_.process_degc,
                    station_.limits.min_degc, station_.limits.max_degc));
  }
  if (bench_.board.status().alive || silence_expected_) last_alive_ = now();
  if (now() - last_alive_ > kSilenceLimit) {
    return Stop(Halt::Why::kRigFault, "the board has been silent for 2 s: check supply and CAN");
  }
  return {};
}

void BenchLoop::WatchBoots() {
  const std::uint32_t boots = bench_.board.status().boots_seen;
  if (boots != boots_ && !boot_expected_ && !silence_expected_) {
    log_.Alarm("the board rebooted on its own: check its supply");
  }
  boots_ = boots;
}

void BenchLoop::WatchWallTime() {
  const UtcNs utc = bench_.clock.utc();
  if (utc < last_utc_) {
    log_.Alarm(fmt::format("{}by {:.3f} s (was the host's clock set?)", kDateBackwards,
                           static_cast<double>(last_utc_ - utc) * 1e-9));
  }
  last_utc_ = utc;
}

double BenchLoop::ReadAir() {
  Environment::Reading air{station_.model.ambient_degc, station_.humidity_pct};
  if (bench_.environment) air = bench_.environment->Read(now() + kPlateDeadline).value_or(air);
  dew_point_degc_ = DewPoint_degc(air.ambient_degc, air.humidity_pct);
  return air.ambient_degc;
}

Flow BenchLoop::RefuseCondensation(double degc) const {
  if (station_.purge || !dew_point_degc_ || degc >= *dew_point_degc_) return {};
  return Stop(
      Halt::Why::kSafetyTrip,
      fmt::format("set point {:.1f} degC is below the dew point of {:.1f} degC: it takes dry "
                  "gas (purge = true)",
                  degc, *dew_point_degc_));
}

Flow BenchLoop::CheckStop() const {
  const int level = stop_.level.load(std::memory_order_relaxed);
  const bool safe_point = !stimuli_.provoking() && !silence_expected_;
  if (level >= 2 || (level == 1 && safe_point)) {
    return Stop(Halt::Why::kInterrupted, "stopped on request");
  }
  return {};
}

Flow BenchLoop::SetTarget(double degc) {
  if (auto flow = RefuseCondensation(degc); !flow) return flow;
  target_degc_ = degc;
  return FromStatus(bench_.plate.SetTarget(degc, now() + kPlateDeadline));
}

Flow BenchLoop::StartRamp(double to_degc, double rate_degc_per_min) {
  // Before the first set point the plate is where it is.
  const double from_degc = target_degc_.value_or(plate_.process_degc);
  const double sign = to_degc >= from_degc ? 1 : -1;
  ramp_ = RampPlan{from_degc, to_degc, sign * rate_degc_per_min / 60, now()};
  return {};
}

Flow BenchLoop::FollowRamp() {
  if (!ramp_) return {};
  const double wanted = ramp_->from_degc + ramp_->rate_degc_per_s * ToSeconds(now() - ramp_->start);
  const bool there =
      ramp_->rate_degc_per_s > 0 ? wanted >= ramp_->to_degc : wanted <= ramp_->to_degc;
  const double target = there ? ramp_->to_degc : wanted;
  if (there) ramp_.reset();
  return SetTarget(target);
}

std::optional<double> BenchLoop::board_degc() const {
  if (silence_expected_ || !log_.snapshot().imu_degc_seen) return std::nullopt;
  return log_.snapshot().imu_degc;
}

void BenchLoop::ExpectSilence(bool silent) {
  silence_expected_ = silent;
  last_alive_ = now();
  boots_ = bench_.board.status().boots_seen;
}

Flow BenchLoop::ReadDecisions() {
  next_decisions_ = now() + kDecisionPeriod;
  const auto records = bench_.board.ReadNewLogRecords(now() + kBoardDeadline);
  if (!records) return Stop(Halt::Why::kRigFault, records.error().message);
  for (const auto& bytes : *records) log_.Write(LogItem{log_.now_us(), bytes});
  return {};
}

void BenchLoop::ExpectBoot(bool expected) {
  boot_expected_ = expected;
  boots_ = bench_.board.status().boots_seen;
}

Result<TableSnapshot> BenchLoop::PeekTable() {
  return bench_.board.ReadTable(now() + kBoardDeadline);
}

void BenchLoop::Record(std::uint8_t when, const TableSnapshot& table) {
  log_.Write(TableItem{log_.now_us(), when, table.crc32, table.image});
}

Flow BenchLoop::ReadTable(std::uint8_t when) {
  const auto table = PeekTable();
  if (!table) return Stop(Halt::Why::kRigFault, table.error().message);
  Record(when, *table);
  return {};
}

}  // namespace zrobench
