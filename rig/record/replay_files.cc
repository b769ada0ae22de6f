#include "rig/record/replay_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

constexpr float kFactorySigmaDps = 0.005f;  ///< where the file does not say
constexpr std::array<std::string_view, 5> kFactoryColumns = {"temp_degc", "zro_x_dps", "zro_y_dps",
                                                             "zro_z_dps", "sigma_dps"};

std::vector<std::string> Fields(std::string line) {
  std::erase_if(line, [](char c) { return c == ' ' || c == '\r' || c == '\t'; });
  std::vector<std::string> fields(1);
  for (char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::string Where(const std::filesystem::path& csv, std::size_t line, std::string_view what) {
  return fmt::format("{}:{}: error: {}", csv.string(), line, what);
}

/// Where each factory column stands in the header; npos for the optional one.
Result<std::array<std::size_t, 5>> Locate(const std::filesystem::path& csv,
                                          const std::vector<std::string>& header) {
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

std::optional<float> Parse(const std::vector<std::string>& fields, std::size_t at) {
  if (at >= fields.size()) return std::nullopt;
  float value = 0;
  const char* const end = fields[at].data() + fields[at].size();
  const auto parsed = std::from_chars(fields[at].data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

Status AddEntry(const std::string& where, const std::array<std::optional<float>, 5>& numbers,
                zro::Corrector& corrector) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (!numbers[i]) {
      return Fail(Error::Kind::kConfig,
                  fmt::format("{}{} is no finite number", where, kFactoryColumns[i]));
    }
  }
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
  std::ifstream in(csv);
  std::string line;
  if (!in || !std::getline(in, line)) {
    return Fail(Error::Kind::kConfig, fmt::format("{}: cannot be read or is empty", csv.string()));
  }
  const auto at = Locate(csv, Fields(line));
  if (!at) return tl::unexpected(at.error());
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    const auto fields = Fields(line);
    if (fields.size() == 1 && fields[0].empty()) continue;
    std::array<std::optional<float>, 5> numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = Parse(fields, (*at)[i]);
    if (Status status = AddEntry(Where(csv, number, ""), numbers, corrector); !status)
      return status;
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
