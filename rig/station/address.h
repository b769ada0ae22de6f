#pragma once
#include <string>
#include <string_view>

namespace zrobench {

enum class Role { kPlate, kSpeaker, kBoard, kPower, kEnvironment };

/// Why `address` cannot be the address of an instrument in this role; empty when it can be.
/// Syntax only: nothing is opened. Forms: docs/formats.md, "Instrument addresses".
std::string AddressFault(Role role, std::string_view address);

}  // namespace zrobench
