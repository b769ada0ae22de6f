#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "corrector/types.h"

namespace zrobench {

/// One record of the board's decision log in units (object 0x2201; corrector/node/event_log.h).
struct Decision {
  std::uint32_t seq = 0;
  std::uint32_t device_us = 0;
  zro::Code code = zro::Code::kNone;
  std::uint8_t axis = zro::kNoAxis;
  std::uint8_t bin = zro::kNoBin;
  double temp_degc = 0;
  std::array<double, 3> measured_dps{};
  double limit = 0, value = 0;  ///< unit of the code's quantity
};

/// Nothing when the record's CRC-16 is wrong.
std::optional<Decision> ParseDecision(std::span<const std::uint8_t, 24> bytes);

/// "motion", "overwrote_old", ... as in zrobench.dbc; "unknown" for a number that is no code.
std::string_view CodeName(zro::Code code);

}  // namespace zrobench
