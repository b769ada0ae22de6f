// lockstep: the host runs the board's software again over the recorded integers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "corrector/config.h"
#include "rig/record/item_reader.h"
#include "rig/record/replica.h"
#include "rig/run/checks/checks.h"
#include "rig/run/judge.h"

namespace zrobench {
namespace {

using Log = std::vector<std::array<std::uint8_t, 24>>;

/// One boot's life: what the board's log gave, and where the host's log of it begins.
struct Life {
  Log board;
  std::size_t host_begin = 0;
};

/// Feeds the replica and compares wherever the record shows what the board itself had.
struct Comparison {
  Replica& replica;
  std::vector<Life> lives = {Life{}};
  int tables = 0, tables_different = 0;
  std::uint64_t first_different_us = 0;

  template <typename T>
  void operator()(const T& item) {
    const std::uint32_t boots = replica.boots();
    const std::size_t host_begin = replica.log().size();
    replica.On(item);
    if (replica.boots() != boots) lives.push_back({{}, host_begin});
  }
  void operator()(const LogItem& item) { lives.back().board.push_back(item.bytes); }
  void operator()(const TableItem& item) {
    if (replica.boots() == 0) return;  // the start image: what the replica was made of
    ++tables;
    if (item.image == replica.TableImage()) return;
    if (tables_different++ == 0) first_different_us = item.at_us;
  }
};

/// Events of one side that the other lacks: board's in order within the host's, and what the host
/// has between them. What the host has after the last of them the board may have kept to itself:
/// its log was not read again before the supply went or the run ended.
std::size_t EventDifferences(const Log& board, std::span<const Log::value_type> host) {
  std::size_t matched = 0;
  auto from = host.begin();
  for (const auto& record : board) {
    const auto found = std::find(from, host.end(), record);
    if (found == host.end()) continue;
    ++matched;
    from = found + 1;
  }
  const auto reached = static_cast<std::size_t>(from - host.begin());
  return (board.size() - matched) + (reached - matched);
}

std::size_t EventDifferences(const Comparison& comparison) {
  const std::span<const Log::value_type> host = comparison.replica.log();
  std::size_t differences = 0;
  for (std::size_t i = 0; i < comparison.lives.size(); ++i) {
    const Life& life = comparison.lives[i];
    const bool last = i + 1 == comparison.lives.size();
    const std::size_t end = last ? host.size() : comparison.lives[i + 1].host_begin;
    differences +=
        EventDifferences(life.board, host.subspan(life.host_begin, end - life.host_begin));
  }
  return differences;
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
  CheckResult result = StartCheck(
      expect, "host re-run of the corrector gives the board's tables, events and rates exactly");
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
      Count("events_different", EventDifferences(comparison), evidence),
      Count("replies_different", (*replica)->replies().different, evidence),
      Count("rates_different", (*replica)->rates().different, evidence)};
  result.reason = FirstDifference(comparison);
  JudgeCheck(result);
  const std::uint64_t lost =
      (*replica)->lost_inputs() + evidence.samples_lost + evidence.inputs_lost;
  const std::uint64_t unseen = evidence.decisions_lost;
  if (lost > 0 || unseen > 0 || comparison.tables == 0) {
    result.verdict = Verdict::kInconclusive;
    result.reason = lost > 0 ? fmt::format("{} inputs of the corrector are not in the record", lost)
                    : unseen > 0
                        ? fmt::format("{} decisions of the board are not in the record", unseen)
                        : "the record holds no table of the board after its boot";
  }
  return result;
}

}  // namespace zrobench
