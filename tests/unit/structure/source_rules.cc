#include "tests/unit/structure/source_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace zrobench::structure {
namespace {

constexpr std::size_t kMaxLines = 400;

const std::set<std::string> kAll = {"core",        "corrector",   "corrector/node", "drivers",
                                    "rig/physics", "rig/virtual", "rig/station",    "rig/profile",
                                    "rig/run",     "rig/record",  "rig/diagnose",   "rig/report",
                                    "dashboard"};

// Room -> rooms it may include, beside itself.
const std::map<std::string, std::set<std::string>>& Allowed() {
  const std::set<std::string> target = {"corrector", "corrector/node"};
  const auto with_target = [&target](std::set<std::string> rooms) {
    rooms.insert(target.begin(), target.end());
    return rooms;
  };
  static const std::map<std::string, std::set<std::string>> allowed = {
      {"core", {}},
      {"corrector", {}},
      {"corrector/node", {"corrector"}},
      {"corrector/firmware", target},
      {"drivers", with_target({"core"})},
      {"rig/physics", {"core"}},
      {"rig/station", {"core", "rig/physics"}},
      {"rig/record", with_target({"core"})},
      {"rig/profile", {"core", "rig/station", "rig/physics"}},
      {"rig/virtual", with_target({"core", "rig/physics", "rig/station", "drivers"})},
      {"rig/run", with_target({"core", "rig/profile", "rig/station", "drivers", "rig/record"})},
      {"rig/diagnose", {"core", "rig/physics", "rig/record", "rig/station", "rig/profile"}},
      {"rig/report", {"core", "rig/record"}},
      {"dashboard", {"core", "rig/record"}},
      {"rig/cli", kAll},
  };
  return allowed;
}

// What a freestanding corrector may have of the library: types and the four functions it names.
const std::set<std::string> kTargetHeaders = {"cstdint",   "cstddef",  "cstring", "cmath",
                                              "stdint.h",  "stddef.h", "math.h",  "string.h",
                                              "stdbool.h", "new"};

std::vector<std::string> Lines(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// An include of ours or of the libraries; the first group is our header's path.
const std::regex kInclude("^\\s*#\\s*include\\s*(?:\"([^\"]+)\"|<)");

std::string Fault(std::string_view path, std::size_t line, const std::string& what) {
  return fmt::format("{}:{}: {}", path, line, what);
}

std::vector<std::string> FaultsWhere(std::string_view path, std::string_view text,
                                     const std::regex& forbidden, std::string_view why) {
  std::vector<std::string> faults;
  std::size_t number = 0;
  for (const std::string& line : Lines(WithoutComments(text))) {
    ++number;
    std::smatch match;
    if (std::regex_search(line, match, forbidden)) {
      faults.push_back(Fault(path, number, fmt::format("{}: {}", match.str(1), why)));
    }
  }
  return faults;
}

// Length of the comment or quotation that begins at `text`; 0 where none does.
std::size_t HiddenLength(std::string_view text) {
  if (text.starts_with("//")) return std::min(text.find('\n'), text.size());
  if (text.starts_with("/*")) return std::min(text.find("*/", 2), text.size() - 2) + 2;
  if (text.starts_with("R\"(")) return std::min(text.find(")\"", 3), text.size() - 2) + 2;
  if (text.empty() || text[0] != '"') return 0;
  std::size_t end = 1;
  while (end < text.size() && text[end] != '"' && text[end] != '\n') {
    end += text[end] == '\\' ? 2 : 1;
  }
  return std::min(end + 1, text.size());
}

}  // namespace

std::string WithoutComments(std::string_view text) {
  std::string bare;
  bool directive = false;
  for (std::size_t i = 0; i < text.size();) {
    if (bare.empty() || bare.back() == '\n') {
      const std::size_t first = text.find_first_not_of(" \t", i);
      directive = first != std::string_view::npos && text[first] == '#';
    }
    const bool quotation = text[i] == '"' && directive;
    const std::size_t hidden = quotation ? 0 : HiddenLength(text.substr(i));
    if (hidden == 0) {
      bare += text[i++];
      continue;
    }
    const std::string_view gone = text.substr(i, hidden);
    bare.append(static_cast<std::size_t>(std::count(gone.begin(), gone.end(), '\n')), '\n');
    i += hidden;
  }
  return bare;
}

std::string RoomOf(std::string_view path) {
  std::string best;
  for (const auto& [room, rooms] : Allowed()) {
    if (path.starts_with(room + "/") && room.size() > best.size()) best = room;
  }
  return best;
}

std::vector<std::string> IncludeFaults(std::string_view path, std::string_view text) {
  const std::string room = RoomOf(path);
  const bool test = path.starts_with("tests/");
  std::vector<std::string> faults;
  std::size_t number = 0;
  for (const std::string& line : Lines(WithoutComments(text))) {
    ++number;
    std::smatch match;
    if (!std::regex_search(line, match, kInclude) || !match[1].matched) continue;
    const std::string included = match[1];
    const std::string other = RoomOf(included);
    if (other == "rig/cli" && room != "rig/cli") {
      faults.push_back(Fault(path, number, "nobody includes rig/cli: " + included));
    } else if (test || (!room.empty() && other == room)) {
      continue;
    } else if (other.empty()) {
      faults.push_back(Fault(path, number, "not rooted at a room: " + included));
    } else if (!room.empty() && !Allowed().at(room).contains(other)) {
      faults.push_back(Fault(path, number, fmt::format("{} may not include {}", room, included)));
    }
  }
  return faults;
}

std::vector<std::string> ClockFaults(std::string_view path, std::string_view text) {
  static const std::regex kClocks(
      "\\b(sleep_for|sleep_until|system_clock|steady_clock|high_resolution_clock|clock_gettime|"
      "gettimeofday|nanosleep|usleep)\\b");
  if (path == "core/clock.cc" || path.starts_with("tests/")) return {};
  return FaultsWhere(path, text, kClocks, "waits and stamps go through core/clock.h");
}

std::vector<std::string> FreestandingFaults(std::string_view path, std::string_view text) {
  static const std::regex kForbidden(
      "\\b(double|new(?! "
      "*\\(|>)|delete|throw|try|catch|dynamic_cast|typeid|malloc|free|std::string|"
      "std::vector|std::function|std::map)\\b");
  static const std::regex kDefaulted("=\\s*delete\\b");
  static const std::regex kSystem("^\\s*#\\s*include\\s*<([^>]+)>");
  if (!path.starts_with("corrector/")) return {};
  const std::string permitted = std::regex_replace(WithoutComments(text), kDefaulted, "");
  std::vector<std::string> faults =
      FaultsWhere(path, permitted, kForbidden, "not on the target (freestanding)");
  std::size_t number = 0;
  for (const std::string& line : Lines(permitted)) {
    ++number;
    std::smatch match;
    if (std::regex_search(line, match, kSystem) && !kTargetHeaders.contains(match[1])) {
      faults.push_back(
          Fault(path, number, fmt::format("<{}>: not on the target (freestanding)", match.str(1))));
    }
  }
  return faults;
}

std::vector<std::string> LengthFaults(std::string_view path, std::string_view text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  if (lines <= kMaxLines) return {};
  return {Fault(path, lines, fmt::format("{} lines, at most {}", lines, kMaxLines))};
}

std::vector<std::string> OwnHeaderFaults(std::string_view path, std::string_view text) {
  if (!path.ends_with(".cc")) return {};
  const std::string own = std::string(path.substr(0, path.size() - 3)) + ".h";
  std::size_t number = 0;
  std::size_t includes = 0;
  for (const std::string& line : Lines(WithoutComments(text))) {
    ++number;
    std::smatch match;
    if (!std::regex_search(line, match, kInclude)) continue;
    if (match[1] == own && includes > 0) return {Fault(path, number, "not the first: " + own)};
    ++includes;
  }
  return {};
}

}  // namespace zrobench::structure
