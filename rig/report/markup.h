#pragma once
#include <string>
#include <string_view>

namespace zrobench {

/// `text` as character data or as an attribute's value of XML 1.0 and HTML alike: `& < > " '`, line
/// breaks and tabs become references; invalid UTF-8 and characters that XML 1.0 (section 2.2)
/// forbids become U+FFFD.
std::string Escaped(std::string_view text);

}  // namespace zrobench
