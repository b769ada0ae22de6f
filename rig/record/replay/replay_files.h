#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "corrector/corrector.h"

namespace zrobench {

/// A CSV that a replay writes, one line at a time; nothing where no file is wanted. Errors stick
/// and come out at Close().
class CsvFile {
 public:
  Status Open(const std::optional<std::filesystem::path>& path, std::string_view header);
  bool wanted() const { return file_ != nullptr; }
  template <typename... Args>
  void Line(fmt::format_string<Args...> format, Args&&... args) {
    line_.clear();
    fmt::format_to(fmt::appender(line_), format, std::forward<Args>(args)...);
    line_.push_back('\n');
    std::fwrite(line_.data(), 1, line_.size(), file_.get());
  }
  Status Close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Closer> file_;
  fmt::memory_buffer line_;
};

/// A factory's entries: `temp_degc, zro_x_dps, zro_y_dps, zro_z_dps [, sigma_dps]`. Adds them and
/// commits. kConfig with file:line when the file is wrong or an entry is refused.
Status AddFactoryEntries(const std::filesystem::path& csv, zro::Corrector& corrector);

/// Writes `temp_degc, zro_x_dps, zro_y_dps, zro_z_dps, date, weight_x, weight_y, weight_z, origin`.
Status WriteTable(const std::filesystem::path& csv, const zro::Table& table);

}  // namespace zrobench
