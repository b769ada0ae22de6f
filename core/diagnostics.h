#pragma once
#include <string>
#include <vector>

#include "core/result.h"

namespace zrobench {

/// A position in a text file; both count from 1, columns in characters.
struct Place {
  int line = 1;
  int column = 1;
};

/// Collects every complaint about one file, so that one reading shows all of them. Messages come
/// out in file order and in the compilers' form, which editors and CI systems know how to open.
class Diagnostics {
 public:
  /// `file`: the name as the user gave it.
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}

  void Add(Place at, std::string message);
  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }
  const std::string& file() const { return file_; }
  /// All of them, one `file:line:column: error: message` a line, as a kConfig error.
  Error error() const;

 private:
  struct Entry {
    Place at;
    std::string message;
  };
  std::string file_;
  std::vector<Entry> entries_;
};

}  // namespace zrobench
