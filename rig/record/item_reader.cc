#include "rig/record/item_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "rig/record/recorder.h"

namespace zrobench {
namespace {

constexpr std::size_t kMaxMessageId = 1023;  ///< keeps a damaged 'A' message from claiming memory

std::string_view AsText(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <typename T>
std::vector<std::uint8_t> PackedDefault() {
  std::vector<std::uint8_t> packed(kItemBytes<T>);
  PackItem(T{}, packed.data());
  return packed;
}

std::vector<std::uint8_t> PackedDefaultOf(int item) {
  static const auto defaults = []<typename... T>(std::type_identity<std::tuple<T...>>) {
    return std::vector<std::vector<std::uint8_t>>{PackedDefault<T>()...};
  }(std::type_identity<DataItems>());
  return defaults[static_cast<std::size_t>(item)];
}

/// Index in DataItems of the message `name`, -1 when it is none of ours.
int ItemNamed(std::string_view name) {
  const auto& formats = ItemFormats();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (std::string_view(formats[i]).substr(0, formats[i].find(':')) == name) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

}  // namespace

Result<ItemReader> ItemReader::Open(const std::filesystem::path& path) {
  auto reader = ulog::Reader::Open(path);
  if (!reader) return tl::unexpected(reader.error());
  return ItemReader(std::move(*reader));
}

void ItemReader::Define(const ulog::Message& message) {
  if (message.type == 'F') {
    const std::string_view text = AsText(message.body);
    if (text.find(':') == text.npos) return reader_.Reject("a format without a name");
    formats_.insert_or_assign(std::string(text.substr(0, text.find(':'))), std::string(text));
  } else if (message.type == 'A') {
    Subscribe(message.body);
  } else if (message.type == 'I') {
    AddInfo(message.body);
  }
}

void ItemReader::AddInfo(std::span<const std::uint8_t> body) {
  if (body.empty() || body.size() < 1U + body[0]) return reader_.Reject("an information cut short");
  const std::string_view typed = AsText(body.subspan(1, body[0]));
  if (!typed.starts_with("char[")) return;
  const std::string_view value = AsText(body.subspan(1U + body[0]));
  info_.insert_or_assign(std::string(typed.substr(typed.find(' ') + 1)), std::string(value));
}

void ItemReader::Subscribe(std::span<const std::uint8_t> body) {
  const std::size_t id = body[1] | static_cast<std::size_t>(body[2]) << 8;
  const std::string name(AsText(body.subspan(3)));
  const auto text = formats_.find(name);
  if (id > kMaxMessageId || text == formats_.end()) {
    return reader_.Reject(fmt::format("message id {} announced for no known format", id));
  }
  if (mappings_.size() <= id) mappings_.resize(id + 1);
  Mapping& mapping = mappings_[id] = Mapping{};
  mapping.announced = true;
  const auto theirs = ulog::ParseFormat(text->second);
  mapping.item = theirs ? ItemNamed(name) : -1;
  if (mapping.item < 0) return;
  const std::string& own_text = ItemFormats()[static_cast<std::size_t>(mapping.item)];
  mapping.identical = own_text == text->second;
  mapping.bytes = theirs->bytes;
  mapping.packed = PackedDefaultOf(mapping.item);
  const auto ours = ulog::ParseFormat(own_text);
  for (const ulog::Field& own : ours->fields) {
    for (const ulog::Field& their : theirs->fields) {
      if (their.name != own.name || their.type != own.type) continue;
      mapping.copies.push_back({their.offset, own.offset, std::min(their.bytes, own.bytes)});
    }
  }
}

const std::uint8_t* ItemReader::Packed(std::span<const std::uint8_t> body, int& item) {
  const std::size_t id = body[0] | static_cast<std::size_t>(body[1]) << 8;
  if (id >= mappings_.size() || !mappings_[id].announced) {
    reader_.Reject(fmt::format("data of message id {}, which nothing announced", id));
    return nullptr;
  }
  Mapping& mapping = mappings_[id];
  if (mapping.item < 0) return nullptr;
  body = body.subspan(2);
  if (body.size() != mapping.bytes) {
    reader_.Reject(
        fmt::format("{} bytes of data where its format has {}", body.size(), mapping.bytes));
    return nullptr;
  }
  item = mapping.item;
  if (mapping.identical) return body.data();
  for (const Copy& copy : mapping.copies) {
    std::memcpy(mapping.packed.data() + copy.to, body.data() + copy.from, copy.bytes);
  }
  return mapping.packed.data();
}

bool ItemReader::ReadSnapshot(std::span<const std::uint8_t> body, SnapshotItem& item) {
  const std::string_view text = AsText(body.subspan(9));
  if (!text.starts_with(kSnapshotPrefix)) return false;
  std::memcpy(&item.at_us, body.data() + 1, sizeof item.at_us);
  item.json = text.substr(kSnapshotPrefix.size());
  return true;
}

}  // namespace zrobench
