#include "rig/station/address.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "core/key_names.h"

namespace zrobench {
namespace {

enum class Form { kNothing, kHostPort, kPath, kInterface };
struct Scheme {
  std::string_view name;  // with its separator
  Form form;
  std::vector<Role> roles;
};

const std::vector<Scheme>& Schemes() {
  using enum Role;
  static const std::vector<Scheme> schemes = {
      {"virtual:", Form::kNothing, {kPlate, kSpeaker, kBoard, kPower, kEnvironment}},
      {"modbus-tcp://", Form::kHostPort, {kPlate, kPower, kEnvironment}},
      {"modbus-rtu:", Form::kPath, {kPlate, kPower, kEnvironment}},
      {"scpi-tcp://", Form::kHostPort, {kSpeaker, kPower, kEnvironment}},
      {"scpi:", Form::kPath, {kSpeaker, kPower, kEnvironment}},
      {"jds6600:", Form::kPath, {kSpeaker}},
      {"can:", Form::kInterface, {kBoard}},
      {"slcan-tcp://", Form::kHostPort, {kBoard}},
      {"slcan:", Form::kPath, {kBoard}},
      {"unix-can:", Form::kPath, {kBoard}},
  };
  return schemes;
}

std::string_view RoleName(Role role) {
  constexpr std::string_view kNames[] = {"plate", "speaker", "board", "power", "environment"};
  return kNames[static_cast<std::size_t>(role)];
}

bool IsNumber(std::string_view text, long low, long high) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
}

std::string HostPortFault(std::string_view rest) {
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos || colon == 0) return "wants HOST:PORT";
  if (!IsNumber(rest.substr(colon + 1), 1, 65535)) return "wants a port between 1 and 65535";
  return "";
}

std::string PathFault(std::string_view rest) {
  const std::size_t query = rest.find('?');
  const std::string_view path = rest.substr(0, query);
  if (path.empty() || path == "pty:") return "wants a path, or pty:NAME";
  if (query == std::string_view::npos) return "";
  const std::string_view option = rest.substr(query + 1);
  if (!option.starts_with("baud=") || !IsNumber(option.substr(5), 50, 4'000'000)) {
    return "knows one option, ?baud=N with N between 50 and 4000000";
  }
  return "";
}

std::string FormFault(Form form, std::string_view rest) {
  switch (form) {
    case Form::kNothing:
      return rest.empty() ? "" : "takes nothing after the colon";
    case Form::kHostPort:
      return HostPortFault(rest);
    case Form::kPath:
      return PathFault(rest);
    case Form::kInterface:  // IFNAMSIZ: 15 characters and a zero
      if (rest.empty() || rest.size() > 15) return "wants an interface name as in can:can0";
      return "";
  }
  return "";
}

}  // namespace

std::string AddressFault(Role role, std::string_view address) {
  const auto serves = [role](const Scheme& s) {
    return std::find(s.roles.begin(), s.roles.end(), role) != s.roles.end();
  };
  for (const Scheme& scheme : Schemes()) {
    if (!address.starts_with(scheme.name) || !serves(scheme)) continue;
    const std::string fault = FormFault(scheme.form, address.substr(scheme.name.size()));
    return fault.empty() ? "" : fmt::format("{} {}", scheme.name, fault);
  }
  std::vector<std::string_view> names;
  for (const Scheme& scheme : Schemes()) {
    if (serves(scheme)) names.push_back(scheme.name);
  }
  return fmt::format("\"{}\" is no address of a {}; it begins with one of {}", address,
                     RoleName(role), fmt::join(names, ", "));
}

}  // namespace zrobench
