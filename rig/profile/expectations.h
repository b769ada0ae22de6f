#pragma once
#include <optional>

#include "core/toml_reader.h"
#include "rig/profile/profile.h"

namespace zrobench {

/// Reads the one table of an [[expect]], named after its check. Empty when there is none that can
/// be used (reported). Numbers and texts keep the key's name; `code = 4` becomes `codes = [4]`.
std::optional<Expectation> ReadExpectation(TableReader* expect);

}  // namespace zrobench
