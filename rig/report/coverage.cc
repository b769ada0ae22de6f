#include "rig/report/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace zrobench {
namespace {

constexpr double kFirst_degc = zro::Table::kFirstBinDegc;

std::vector<Coverage::Bin> BinsBetween(double from_degc, double to_degc, double width_degc) {
  std::vector<Coverage::Bin> bins;
  double edge = kFirst_degc + std::floor((from_degc - kFirst_degc) / width_degc) * width_degc;
  for (; edge < to_degc || bins.empty(); edge += width_degc) {
    Coverage::Bin bin;
    bin.from_degc = edge;
    bin.to_degc = edge + width_degc;
    bins.push_back(bin);
  }
  return bins;
}

Coverage::Bin* BinAt(std::vector<Coverage::Bin>& bins, double degc) {
  const auto bin = std::find_if(bins.begin(), bins.end(), [degc](const Coverage::Bin& b) {
    return degc >= b.from_degc && degc < b.to_degc;
  });
  return bin == bins.end() ? nullptr : &*bin;
}

void CountRefusal(const History::Reading& reading, Coverage& coverage) {
  const Decision& decision = reading.decision;
  const std::size_t code = static_cast<std::size_t>(decision.code) - 1;
  Coverage::CodeCount& count = coverage.codes[code];
  ++(reading.expected() ? count.expected : count.unexpected);
  if (decision.axis < coverage.blamed.size()) ++coverage.blamed[decision.axis];
  if (Coverage::Bin* const bin = BinAt(coverage.bins, decision.temp_degc)) {
    ++bin->refused[std::min<std::size_t>(decision.axis, 3)];
    ++bin->codes[code];
  }
}

void CountReadings(const History& history, Coverage& coverage) {
  for (const History::Reading& reading : history.readings) {
    if (zro::IsRejection(reading.decision.code)) {
      CountRefusal(reading, coverage);
    } else if (Coverage::Bin* const bin = BinAt(coverage.bins, reading.decision.temp_degc);
               bin && IsAccepted(reading.decision.code)) {
      ++bin->accepted;
    }
  }
}

void MarkEntries(const zro::Table& table, Coverage& coverage) {
  for (int i = 0; i < table.size(); ++i) {
    Coverage::Bin* const bin = BinAt(coverage.bins, double{table[i].temp_degc});
    if (bin == nullptr) continue;
    (table[i].origin == zro::Origin::kFactory ? bin->factory : bin->learned) = true;
  }
}

}  // namespace

bool Coverage::Bin::any_reading() const {
  return accepted + std::accumulate(refused.begin(), refused.end(), 0) > 0;
}

Coverage CoverageOf(const History& history) {
  Coverage coverage;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low_degc = kInfinity, high_degc = -kInfinity;
  for (const History::PlatePoint& point : history.plate) {
    low_degc = std::fmin(low_degc, point.setpoint_degc);  // NaN does not count
    high_degc = std::fmax(high_degc, point.setpoint_degc);
  }
  if (low_degc <= high_degc) {
    coverage.bins = BinsBetween(low_degc, high_degc, double{history.table.bin_degc()});
  }
  for (const History::Second& second : history.seconds) {
    Coverage::Bin* const bin = BinAt(coverage.bins, second.board_degc);
    if (bin && second.quiet) ++bin->quiet_s;
  }
  CountReadings(history, coverage);
  MarkEntries(history.table, coverage);
  return coverage;
}

}  // namespace zrobench
