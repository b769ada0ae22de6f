#include "rig/run/bench_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zrobench {
namespace {

constexpr auto kTick = std::chrono::milliseconds(100);
constexpr auto kPlateDeadline = std::chrono::seconds(2);
constexpr auto kBoardDeadline = std::chrono::seconds(10);
constexpr auto kDecisionPeriod = std::chrono::seconds(5);
constexpr auto kSilenceLimit = std::chrono::seconds(2);  ///< no frame from the board: rig fault
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
      target_degc_(station.model.ambient_degc),
      next_second_(bench.clock.now()),
      next_decisions_(bench.clock.now() + kDecisionPeriod),
      last_alive_(bench.clock.now()) {}

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
  double ambient_degc = station_.model.ambient_degc;
  if (bench_.environment) {
    if (const auto air = bench_.environment->Read(now() + kPlateDeadline)) {
      ambient_degc = air->ambient_degc;
    }
  }
  log_.Write(PlateItem{log_.now_us(), plate_.setpoint_degc, plate_.process_degc, plate_.drive_pct,
                       ambient_degc});
  if (auto flow = FromStatus(bench_.board.SendHeartbeat()); !flow) return flow;
  return Watch();
}

Flow BenchLoop::Watch() {
  const Status& record = log_.recorder().status();
  if (!record) return Stop(Halt::Why::kRigFault, record.error().message);
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

Flow BenchLoop::CheckStop() const {
  const int level = stop_.level.load(std::memory_order_relaxed);
  if (level >= 2 || (level == 1 && !stimuli_.playing())) {
    return Stop(Halt::Why::kInterrupted, "stopped on request");
  }
  return {};
}

Flow BenchLoop::SetTarget(double degc) {
  target_degc_ = degc;
  return FromStatus(bench_.plate.SetTarget(degc, now() + kPlateDeadline));
}

Flow BenchLoop::StartRamp(double to_degc, double rate_degc_per_min) {
  const double sign = to_degc >= target_degc_ ? 1 : -1;
  ramp_ = RampPlan{target_degc_, to_degc, sign * rate_degc_per_min / 60, now()};
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
  if (silence_expected_ || log_.snapshot().samples == 0) return std::nullopt;
  return log_.snapshot().imu_degc;
}

void BenchLoop::ExpectSilence(bool silent) {
  silence_expected_ = silent;
  last_alive_ = now();
}

Flow BenchLoop::ReadDecisions() {
  next_decisions_ = now() + kDecisionPeriod;
  const auto records = bench_.board.ReadNewLogRecords(now() + kBoardDeadline);
  if (!records) return Stop(Halt::Why::kRigFault, records.error().message);
  for (const auto& bytes : *records) log_.Write(LogItem{log_.now_us(), bytes});
  return {};
}

Result<TableItem> BenchLoop::ReadTable(std::uint8_t when) {
  const auto table = bench_.board.ReadTable(now() + kBoardDeadline);
  if (!table) return tl::unexpected(table.error());
  TableItem item{log_.now_us(), when, table->crc32, table->image};
  log_.Write(item);
  return item;
}

}  // namespace zrobench
