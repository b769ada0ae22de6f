#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/blind/hidden_case.h"

namespace zrobench::blind {

/// The cases of "smoke" or "full", in an order drawn from `seed`, so that a number tells nothing.
/// Throws std::invalid_argument for another name.
std::vector<CaseOrder> OrdersOf(std::string_view set, std::uint64_t seed);

}  // namespace zrobench::blind
