#include "rig/diagnose/gates.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace zrobench::diagnose {
namespace {

constexpr std::size_t kFewestBlocks = 24;  ///< two minutes: less holds no thermal time constant
constexpr double kMoves_k = 2;

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  void Add(double value) {
    if (std::isnan(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double width() const { return high > low ? high - low : 0; }
};

Span SpanOf(const Eigen::ArrayXd& values) {
  Span span;
  for (const double v : values) span.Add(v);
  return span;
}

std::string ChannelFault(const Series& series, std::size_t channel) {
  const std::string_view name = kChannelNames[Index(kMeasuredChannel[channel])];
  const Span span = SpanOf(series.block[channel]);
  const bool temperature = channel <= kDieShown;
  const double most = temperature ? 300 : 4000;
  if (span.high > most || span.low < -most) {
    return fmt::format("{}: {} reaches {:g}: no such sensor gives that; check unit and scale",
                       series.name, name, span.high > most ? span.high : span.low);
  }
  const std::size_t other = channel == kDieShown ? kPlateShown : kDieShown;
  const bool others_move = SpanOf(series.block[other]).width() > kMoves_k;
  if (others_move && std::isfinite(span.high) && span.width() == 0) {
    return fmt::format("{}: {} repeats {:g} while the temperature moves: the sensor is stuck",
                       series.name, name, span.high);
  }
  return "";
}

}  // namespace

std::string UnfitBecause(const Problem& problem) {
  std::size_t blocks = 0;
  for (const Series& series : problem.series) {
    blocks += series.blocks();
    for (std::size_t channel = 0; channel < kMeasured; ++channel) {
      if (!problem.measured[channel]) continue;
      if (std::string fault = ChannelFault(series, channel); !fault.empty()) return fault;
    }
  }
  const bool rates =
      problem.measured[kRateX] || problem.measured[kRateY] || problem.measured[kRateZ];
  if (blocks < kFewestBlocks) {
    return fmt::format("{} blocks of {:g} s are too few: no effect could be told from noise",
                       blocks, problem.series.empty() ? 0 : problem.block_s());
  }
  if (problem.drive == Drive::kNothing && !(problem.measured[kDieShown] && rates)) {
    return "neither a plate nor a gyro with its temperature: there is nothing to compare";
  }
  return "";
}

}  // namespace zrobench::diagnose
