#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "rig/record/item.h"
#include "rig/record/item_fields.h"
#include "rig/record/ulog_writer.h"

namespace zrobench {

/// Writes items to record.ulg. Nothing of the host, the build or real time goes in: the same items
/// give the same bytes. Write() packs into the block buffer without allocation; Flush() and every
/// full block reach the kernel. Thread-compatible. Errors stick (ulog::Writer).
class Recorder {
 public:
  /// Key and value of an information message: "sys_name", "profile", "seed", ...
  using Info = std::vector<std::pair<std::string, std::string>>;

  /// Creates the file with all definitions and flushes them, so that it can be read from now on.
  static Result<std::unique_ptr<Recorder>> Create(const std::filesystem::path& path,
                                                  std::uint64_t start_us, const Info& info);

  template <typename T>
  requires requires { ItemLayout<T>::kName; }
  void Write(const T& item) { PackItem(item, writer_->Reserve(DataItemId<T>(), kItemBytes<T>)); }
  /// A sync mark, then the snapshot as logged text.
  void Write(const SnapshotItem& item);
  void Write(const Item& item);

  Status Flush() { return writer_->Flush(); }
  Status Close() { return writer_->Close(); }
  const Status& status() const { return writer_->status(); }
  std::uint64_t written_bytes() const { return writer_->written_bytes(); }

 private:
  explicit Recorder(std::unique_ptr<ulog::Writer> writer) : writer_(std::move(writer)) {}
  std::unique_ptr<ulog::Writer> writer_;
};

/// Begins the logged text of a SnapshotItem.
inline constexpr std::string_view kSnapshotPrefix = "snapshot ";

}  // namespace zrobench
