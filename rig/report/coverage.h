#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "rig/report/history.h"

namespace zrobench {

/// What a run exercised and, by what is zero here, what it did not: temperature bins of the
/// board's table between the lowest and the highest set point x axes x refusal codes.
struct Coverage {
  static constexpr std::size_t kCodes = 16;
  struct Bin {
    double from_degc = 0, to_degc = 0;
    int quiet_s = 0;                        ///< seconds at rest and in silence
    int accepted = 0;                       ///< readings
    std::array<int, 4> refused{};           ///< readings, by worst axis x, y, z, none
    std::array<int, kCodes> codes{};        ///< of refusal 1..16
    bool factory = false, learned = false;  ///< entries at the end
    bool any_reading() const;
  };
  struct CodeCount {
    int expected = 0, unexpected = 0;
  };
  std::vector<Bin> bins;                  ///< contiguous, ascending; empty when no plate spoke
  std::array<CodeCount, kCodes> codes{};  ///< of refusal 1..16, at any temperature
  std::array<int, 3> blamed{};            ///< refusals by worst axis
};

Coverage CoverageOf(const History& history);

}  // namespace zrobench
