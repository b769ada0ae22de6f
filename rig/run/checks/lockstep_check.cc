// lockstep: the host runs the board's software again over the recorded integers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corrector/config.h"
#include "rig/record/item_reader.h"
#include "rig/record/replica.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"

namespace zrobench {
namespace {

/// Feeds the replica and compares wherever the record shows what the board itself had.
struct Comparison {
  Replica& replica;
  std::vector<std::array<std::uint8_t, 24>> board_log;
  int tables = 0, tables_different = 0;
  std::uint64_t first_different_us = 0;

  template <typename T>
  void operator()(const T& item) {
    replica.On(item);
  }
  void operator()(const LogItem& item) { board_log.push_back(item.bytes); }
  void operator()(const TableItem& item) {
    if (replica.boots() == 0) return;  // the start image: what the replica was made of
    ++tables;
    if (item.image == replica.TableImage()) return;
    if (tables_different++ == 0) first_different_us = item.at_us;
  }
};

/// Events of one side that the other lacks: board's in order within the host's, and the rest.
std::size_t EventDifferences(const std::vector<std::array<std::uint8_t, 24>>& board,
                             const std::vector<std::array<std::uint8_t, 24>>& host) {
  std::size_t matched = 0;
  auto from = host.begin();
  for (const auto& record : board) {
    const auto found = std::find(from, host.end(), record);
    if (found == host.end()) continue;
    ++matched;
    from = found + 1;
  }
  return (board.size() - matched) + (host.size() - matched);
}

Measurement Count(std::string name, std::uint64_t count, const Evidence& evidence) {
  return {.name = "lockstep." + std::move(name),
          .value = static_cast<double>(count),
          .unit = "1",
          .high = 0,
          .first_us = evidence.first_us,
          .last_us = evidence.last_us};
}

std::string FirstDifference(const Comparison& comparison) {
  const Lockstep& rates = comparison.replica.rates();
  if (comparison.tables_different > 0) {
    return fmt::format("the tables differ from {:.3f} s on",
                       static_cast<double>(comparison.first_different_us) * 1e-6);
  }
  if (rates.first_difference_us) {
    return fmt::format("DUT_RATE differs first at {:.3f} s",
                       static_cast<double>(*rates.first_difference_us) * 1e-6);
  }
  return {};
}

}  // namespace

CheckResult CheckLockstep(const Expectation& expect, const CheckContext& context) {
  CheckResult result;
  result.check = expect.check;
  result.about = "host re-run of the corrector gives the board's tables, events and rates exactly";
  const Station& station = context.station;
  const double sample_hz = station.virtual_rig.sample_hz;
  const physics::GyroModel gyro = station.model.gyro.value_or(physics::GyroModel{});
  const auto start = StartImage(context.record);
  auto replica =
      start ? Replica::Create(zro::ConfigFor(static_cast<float>(sample_hz),
                                             static_cast<float>(gyro.noise_density_dps_per_rthz)),
                              zro::node::TimeDividerFor(static_cast<float>(sample_hz)), *start)
            : tl::unexpected(start.error());
  if (!replica) {
    result.reason = replica.error().message;
    return result;
  }
  Comparison comparison{**replica, {}};
  if (const auto end = ReadItems(context.record, comparison); !end) {
    result.reason = end.error().message;
    return result;
  }
  const Evidence& evidence = context.evidence;
  result.measurements = {
      Count("tables_different", static_cast<std::uint64_t>(comparison.tables_different), evidence),
      Count("events_different", EventDifferences(comparison.board_log, (*replica)->log()),
            evidence),
      Count("rates_different", (*replica)->rates().different, evidence)};
  result.reason = FirstDifference(comparison);
  JudgeCheck(result);
  const std::uint64_t lost =
      (*replica)->lost_inputs() + evidence.samples_lost + evidence.inputs_incomplete;
  if (lost > 0 || comparison.tables == 0) {
    result.verdict = Verdict::kInconclusive;
    result.reason = fmt::format("{} inputs of the corrector are not in the record", lost);
  }
  return result;
}

}  // namespace zrobench
