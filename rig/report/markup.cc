#include "rig/report/markup.h"

#include <nlohmann/json.hpp>

namespace zrobench {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// The JSON writer knows UTF-8 and replaces what is none.
std::string ValidUtf8(std::string_view text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace))
      .get<std::string>();
}

/// U+FFFE and U+FFFF, the two that XML forbids beyond the control characters.
bool IsNoncharacter(std::string_view rest) {
  return rest.starts_with("\xEF\xBF\xBE") || rest.starts_with("\xEF\xBF\xBF");
}

void AppendEscaped(char c, std::string& out) {
  switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    case '\'':
      out += "&#39;";
      break;
    case '\t':
    case '\n':
    case '\r':  // written plainly, an attribute would lose them
      out += "&#" + std::to_string(int{c}) + ';';
      break;
    default:
      if (c == '\x7f' || (c >= 0 && c < ' ')) {
        out += kReplacement;
      } else {
        out += c;
      }
  }
}

}  // namespace

std::string Escaped(std::string_view text) {
  const std::string valid = ValidUtf8(text);
  std::string out;
  out.reserve(valid.size());
  for (std::size_t i = 0; i < valid.size(); ++i) {
    if (IsNoncharacter(std::string_view(valid).substr(i))) {
      out += kReplacement;
      i += 2;
    } else {
      AppendEscaped(valid[i], out);
    }
  }
  return out;
}

}  // namespace zrobench
