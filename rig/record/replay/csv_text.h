#pragma once
// Fields and numbers of one CSV line.
#include <optional>
#include <string_view>
#include <vector>

namespace zrobench {

/// Without blanks at both ends, then without the quotes around it.
std::string_view TrimField(std::string_view text);

/// The line's fields, trimmed; they point into `line`. A delimiter between quotes belongs to the
/// field (RFC 4180; a quoted field ends on its line). Delimiter ' ': any run of blanks.
void SplitLine(std::string_view line, char delimiter, std::vector<std::string_view>* fields);

/// A finite number with this decimal sign and nothing else around it; a leading '+' is allowed.
std::optional<double> ParseNumber(std::string_view field, char decimal = '.');

}  // namespace zrobench
