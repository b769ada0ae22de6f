#pragma once
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "rig/record/replay/channel.h"
#include "rig/record/replay/import_map.h"

namespace zrobench {

/// Rows of a CSV in canonical columns and units, one at a time. Without a map the header's
/// canonical names count and other columns are ignored. A last line without its end is left out
/// when it is torn: the logger was killed. Errors are kConfig and begin with `file:line:`; kFile
/// when the file cannot be read on.
class CsvSource {
 public:
  static Result<CsvSource> Open(const std::filesystem::path& path, const ImportMap& map = {});

  /// The next row; nothing at the end. Where there is no time column, time counts rows at the
  /// map's sample rate. Time that goes backwards is an error. Memory does not grow with the file.
  Result<std::optional<Row>> Next();

  bool has(Channel channel) const { return present_[Index(channel)]; }
  std::size_t line() const { return line_; }
  std::size_t skipped_rows() const { return skipped_rows_; }  ///< bad ones, not filtered ones

 private:
  struct Bound {
    Channel channel;
    std::size_t index;
    double scale, offset;
  };
  struct BoundFilter {
    std::size_t index;
    RowFilter filter;
  };

  CsvSource(std::filesystem::path path, ImportMap map)
      : path_(std::move(path)), map_(std::move(map)), in_(path_, std::ios::binary) {}
  Status ReadHeader();
  Status Bind(const std::vector<std::string>& names);
  Result<std::size_t> IndexOf(const ColumnRef& column, const std::vector<std::string>& names) const;
  /// The next line into text_; false at the end.
  Result<bool> ReadLine();
  /// The next line that is neither blank nor a comment, into fields_; false at the end.
  Result<bool> NextLine();
  Result<bool> Passes() const;
  Result<Row> ParseRow() const;
  Result<double> Number(std::size_t index) const;
  /// Time is rows at the stated rate.
  bool counted() const;
  Status Clock(Row& row);
  std::string At(std::string_view what) const;

  std::filesystem::path path_;
  ImportMap map_;
  std::ifstream in_;
  std::vector<char> buffer_;
  std::string_view text_;  ///< the present line, in buffer_
  bool torn_ = false;      ///< the present line is the last and has no end
  std::size_t line_ = 0;
  std::vector<std::string_view> fields_;
  std::vector<Bound> columns_;
  std::vector<BoundFilter> filters_;
  std::array<bool, kChannels> present_{};
  std::uint64_t rows_ = 0;
  std::size_t skipped_rows_ = 0;
  double last_t_s_ = 0;
};

}  // namespace zrobench
