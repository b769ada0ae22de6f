#pragma once
// The rules of the house that a program can check, as pure functions of one file's path and text.
#include <string>
#include <string_view>
#include <vector>

namespace zrobench::structure {

/// Source without comments and without what stands between quotes; line breaks are kept.
/// Preprocessor lines keep their quotes: they hold the includes.
std::string WithoutComments(std::string_view text);

/// The room a file belongs to ("rig/run"), the longest that fits; empty outside of all rooms.
std::string RoomOf(std::string_view path);

/// Each fault as "path:line: what". `path` is relative to the checkout.
std::vector<std::string> IncludeFaults(std::string_view path, std::string_view text);
/// Waits and stamps beside the Clock.
std::vector<std::string> ClockFaults(std::string_view path, std::string_view text);
/// What the target does not have: heap, exceptions, double, most of the libraries.
std::vector<std::string> FreestandingFaults(std::string_view path, std::string_view text);
std::vector<std::string> LengthFaults(std::string_view path, std::string_view text);
/// A source that includes its own header does so first: that proves that the header compiles alone.
std::vector<std::string> OwnHeaderFaults(std::string_view path, std::string_view text);

}  // namespace zrobench::structure
