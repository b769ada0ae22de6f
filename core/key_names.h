#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace zrobench {

/// What to tell someone who wrote `key` where only `known` are allowed: the same name with the
/// right unit, the missing unit, the nearest spelling, or the list of what there is.
std::string SuggestKey(std::string_view key, const std::vector<std::string>& known);

/// The nearest of `known` when it is near enough to be a misspelling; else empty.
std::string NearestName(std::string_view name, const std::vector<std::string>& known);

}  // namespace zrobench
