#pragma once
// The report's template, style and scripts, embedded at build time (cmake/web_assets.cmake).
#include <string_view>

namespace zrobench::web {

extern const std::string_view kReportHtml;  ///< for fmt::format with named arguments (html.cc)
extern const std::string_view kReportCss, kReportJs;
extern const std::string_view kDygraphCss, kDygraphJs;  ///< Debian's libjs-dygraphs, MIT licence

}  // namespace zrobench::web
