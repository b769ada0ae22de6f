#pragma once
// The label of a case, and the hash that binds it before anything is analysed.
#include <string>
#include <string_view>

#include "tests/blind/hidden_case.h"

namespace zrobench::blind {

/// JSON, as README.md describes it; one line a key.
std::string LabelText(const HiddenCase& made, std::string_view name);
/// 256 bits as 64 hexadecimal digits.
std::string Nonce(Draw draw);
/// SHA-256 of the label followed by the nonce, in hexadecimal: `cat label.json nonce | sha256sum`.
std::string SealOf(std::string_view label, std::string_view nonce);

}  // namespace zrobench::blind
