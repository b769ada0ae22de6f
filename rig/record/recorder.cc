#include "rig/record/recorder.h"

#include "core/check.h"

namespace zrobench {

Result<std::unique_ptr<Recorder>> Recorder::Create(const std::filesystem::path& path,
                                                   std::uint64_t start_us, const Info& info) {
  auto writer = ulog::Writer::Create(path, start_us);
  if (!writer) return tl::unexpected(writer.error());
  ulog::Writer& out = **writer;
  out.Info("sys_name", "zrobench");
  for (const auto& [key, value] : info) out.Info(key, value);
  for (const auto& [field, unit] : ItemUnits()) out.Info("unit." + field, unit);
  for (const std::string& format : ItemFormats()) out.Format(format);
  // All formats in front of the first subscription: readers begin their data section there.
  std::uint16_t id = 0;
  for (const std::string& format : ItemFormats())
    out.Subscribe(id++, format.substr(0, format.find(':')));
  if (Status status = out.Flush(); !status) return tl::unexpected(status.error());
  return std::unique_ptr<Recorder>(new Recorder(std::move(*writer)));
}

void Recorder::Write(const SnapshotItem& item) {
  ZROBENCH_CHECK(item.json.size() <= 60000);
  writer_->Sync();
  writer_->Text('7', item.at_us, std::string(kSnapshotPrefix) + item.json);
}

void Recorder::Write(const Item& item) {
  std::visit([this](const auto& concrete) { Write(concrete); }, item);
}

}  // namespace zrobench
