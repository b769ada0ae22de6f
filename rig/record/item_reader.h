#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/result.h"
#include "rig/record/item.h"
#include "rig/record/item_fields.h"
#include "rig/record/ulog_reader.h"

namespace zrobench {

/// Gives a record's items back. Fields are found by the file's own definitions, by name and type:
/// a field that the file lacks keeps its default, foreign fields and messages are skipped.
class ItemReader {
 public:
  /// kFile when the file cannot be opened or is no ULog.
  static Result<ItemReader> Open(const std::filesystem::path& path);

  /// Calls visit(const T&) for each item up to the present end of the file, T any type of Item (a
  /// callable that takes const Item& will do). May be called again on a growing file.
  template <typename Visit>
  void Drain(Visit&& visit) {
    DrainUntil(visit, [] { return false; });
  }
  /// The same, but no further than the item after which `done()` holds.
  template <typename Visit, typename Done>
  void DrainUntil(Visit&& visit, Done&& done) {
    while (!done()) {
      const auto message = reader_.Next();
      if (!message) return;
      if (message->type == 'D') {
        VisitData(message->body, visit);
      } else if (message->type == 'L') {
        if (SnapshotItem item; ReadSnapshot(message->body, item)) visit(std::as_const(item));
      } else {
        Define(*message);
      }
    }
  }

  ulog::End end() const { return reader_.end(); }
  std::uint64_t start_us() const { return reader_.start_us(); }
  /// Information messages of type char[n] read so far.
  const std::map<std::string, std::string>& info() const { return info_; }

 private:
  struct Copy {
    std::size_t from, to, bytes;
  };
  /// How the file's message becomes our packed one.
  struct Mapping {
    bool announced = false;
    int item = -1;  ///< index in DataItems, -1 = foreign
    bool identical = false;
    std::size_t bytes = 0;  ///< of the file's message
    std::vector<Copy> copies;
    std::vector<std::uint8_t> packed;  ///< defaults, overwritten at each message
  };

  explicit ItemReader(ulog::Reader reader) : reader_(std::move(reader)) {}
  void Define(const ulog::Message& message);
  void Subscribe(std::span<const std::uint8_t> body);
  void AddInfo(std::span<const std::uint8_t> body);
  static bool ReadSnapshot(std::span<const std::uint8_t> body, SnapshotItem& item);
  /// The message in our packing; nullptr when it is foreign or damaged.
  const std::uint8_t* Packed(std::span<const std::uint8_t> body, int& item);

  template <typename Visit>
  void VisitData(std::span<const std::uint8_t> body, Visit& visit) {
    int index = -1;
    const std::uint8_t* const packed = Packed(body, index);
    if (packed == nullptr) return;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((index == static_cast<int>(I) ? VisitAs<std::tuple_element_t<I, DataItems>>(packed, visit)
                                     : void()),
       ...);
    }
    (std::make_index_sequence<std::tuple_size_v<DataItems>>());
  }
  template <typename T, typename Visit>
  static void VisitAs(const std::uint8_t* packed, Visit& visit) {
    T item;
    UnpackItem(item, packed);
    visit(std::as_const(item));
  }

  ulog::Reader reader_;
  std::map<std::string, std::string> formats_;  ///< 'F' texts by name
  std::map<std::string, std::string> info_;
  std::vector<Mapping> mappings_;  ///< by message id
};

/// Visits every item of a record and says how it ended: whole, or cut or damaged at which byte.
template <typename Visit>
Result<ulog::End> ReadItems(const std::filesystem::path& path, Visit&& visit) {
  auto reader = ItemReader::Open(path);
  if (!reader) return tl::unexpected(reader.error());
  reader->Drain(visit);
  return reader->end();
}

}  // namespace zrobench
