#include "rig/record/replay/replay_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>
#include <vector>

#include "core/text_file.h"
#include "rig/record/replay/csv_text.h"
#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

constexpr float kFactorySigmaDps = 0.005f;  ///< where the file does not say
constexpr double kMostOfAFactory = 1e6;     ///< beyond are slips; well inside a float
constexpr std::array<std::string_view, 5> kFactoryColumns = {"temp_degc", "zro_x_dps", "zro_y_dps",
                                                             "zro_z_dps", "sigma_dps"};

std::string Where(const std::filesystem::path& csv, std::size_t line, std::string_view what) {
  return fmt::format("{}:{}: error: {}", csv.string(), line, what);
}

/// Where each factory column stands in the header; npos for the optional one.
Result<std::array<std::size_t, 5>> Locate(const std::filesystem::path& csv,
                                          const std::vector<std::string_view>& header) {
  std::array<std::size_t, 5> at{};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto found = std::find(header.begin(), header.end(), kFactoryColumns[i]);
    at[i] = found == header.end() ? std::string::npos
                                  : static_cast<std::size_t>(found - header.begin());
    if (at[i] == std::string::npos && i < 4) {
      return Fail(Error::Kind::kConfig,
                  Where(csv, 1, fmt::format("no column '{}'", kFactoryColumns[i])));
    }
  }
  return at;
}

/// The row's numbers; nothing for the one column that may be left out or blank.
Result<std::array<std::optional<float>, 5>> Numbers(const std::string& where,
                                                    const std::vector<std::string_view>& fields,
                                                    const std::array<std::size_t, 5>& at) {
  std::array<std::optional<float>, 5> numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string_view field = at[i] < fields.size() ? fields[at[i]] : std::string_view();
    if (field.empty() && i == 4) continue;
    const auto value = ParseNumber(field);
    if (!value || std::fabs(*value) > kMostOfAFactory) {
      return Fail(Error::Kind::kConfig, fmt::format("{}{} is '{}': no number fit for a table",
                                                    where, kFactoryColumns[i], field));
    }
    numbers[i] = static_cast<float>(*value);
  }
  return numbers;
}

Status AddEntry(const std::string& where, const std::array<std::optional<float>, 5>& numbers,
                zro::Corrector& corrector) {
  const float zro_dps[3] = {*numbers[1], *numbers[2], *numbers[3]};
  if (corrector.AddFactoryEntry(*numbers[0], zro_dps, numbers[4].value_or(kFactorySigmaDps))) {
    return {};
  }
  return Fail(
      Error::Kind::kConfig,
      fmt::format("{}the corrector refuses this entry: unfit values or a full table", where));
}

}  // namespace

Status CsvFile::Open(const std::optional<std::filesystem::path>& path, std::string_view header) {
  if (!path) return {};
  path_ = *path;
  file_.reset(std::fopen(path_.c_str(), "w"));
  if (!file_) {
    return Fail(Error::Kind::kFile,
                fmt::format("{}: cannot be created: {}", path_.string(), std::strerror(errno)));
  }
  Line("{}", header);
  return {};
}

Status CsvFile::Close() {
  if (!file_) return {};
  const bool failed = std::ferror(file_.get()) != 0;
  if (std::fclose(file_.release()) == 0 && !failed) return {};
  return Fail(Error::Kind::kFile,
              fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}

Status AddFactoryEntries(const std::filesystem::path& csv, zro::Corrector& corrector) {
  const auto text = ReadTextFile(csv);
  if (!text) return Fail(Error::Kind::kConfig, text.error().message);
  std::istringstream in(text->starts_with("\xEF\xBB\xBF") ? text->substr(3) : *text);
  std::string line;
  if (!std::getline(in, line)) return Fail(Error::Kind::kConfig, csv.string() + ": is empty");
  std::vector<std::string_view> fields;
  SplitLine(line, ',', &fields);
  const auto at = Locate(csv, fields);
  if (!at) return tl::unexpected(at.error());
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (TrimField(line).empty()) continue;
    SplitLine(line, ',', &fields);
    const std::string where = Where(csv, number, "");
    const auto numbers = Numbers(where, fields, *at);
    if (!numbers) return tl::unexpected(numbers.error());
    if (Status status = AddEntry(where, *numbers, corrector); !status) return status;
  }
  static_cast<void>(corrector.Commit());  // RAM: cannot fail
  return {};
}

Status WriteTable(const std::filesystem::path& csv, const zro::Table& table) {
  CsvFile file;
  Status status = file.Open(csv,
                            "temp_degc,zro_x_dps,zro_y_dps,zro_z_dps,date,weight_x,weight_y,"
                            "weight_z,origin");
  if (!status) return status;
  for (int i = 0; i < table.size(); ++i) {
    const zro::Entry& e = table[i];
    // One reading gives all three axes, so that they share their weight.
    file.Line("{},{},{},{},{},{},{},{},{}", e.temp_degc, e.zro_dps[0], e.zro_dps[1], e.zro_dps[2],
              e.date == 0 ? "" : CanopenDateText(e.date), e.weight, e.weight, e.weight,
              e.origin == zro::Origin::kFactory ? "factory" : "learned");
  }
  return file.Close();
}

}  // namespace zrobench
