#include "core/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace zrobench {

void Diagnostics::Add(Place at, std::string message) {
  entries_.push_back({at, std::move(message)});
}

Error Diagnostics::error() const {
  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.at.line, a.at.column) < std::tie(b.at.line, b.at.column);
  });
  std::string text;
  for (const Entry& entry : sorted) {
    if (!text.empty()) text += '\n';
    text +=
        fmt::format("{}:{}:{}: error: {}", file_, entry.at.line, entry.at.column, entry.message);
  }
  return Error{Error::Kind::kConfig, text};
}

}  // namespace zrobench
