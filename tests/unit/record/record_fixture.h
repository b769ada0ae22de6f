#pragma once
// A folder that goes away, items of every type, and ways to look at files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "rig/record/item.h"
#include "rig/record/item_reader.h"
#include "rig/record/recorder.h"

namespace zrobench::testing {

class FolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "zrobench-record-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path Path(const std::string& name) const { return folder_ / name; }
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(Path(name), std::ios::binary) << bytes;
    return Path(name);
  }
  static std::string Read(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::filesystem::path folder_;
};

/// One item of every type, no field at its default.
inline std::vector<Item> OneOfEach() {
  TableItem table{10, 2, 0xDEADBEEF, {}};
  for (int i = 0; i < 40; ++i) table.image.push_back(static_cast<std::uint8_t>(200 - i));
  LogItem log{11, {}};
  for (std::size_t i = 0; i < log.bytes.size(); ++i)
    log.bytes[i] = static_cast<std::uint8_t>(7 * i);
  return {ImuSample{1, {-32768, 2, 32767}, {4, -5, 6}, {7, 8, -9}, 10, 0x11, 1, 0xFF},
          ImuTime{2, 4'000'000'000u, 65535, -2560},
          ImuCorrection{3, {-1, 2, -3}, 12, 4, 5},
          BusFrame{4, 0x590, 8, 1, {1, 2, 3, 4, 5, 6, 7, 255}},
          PlateItem{5, 45.25, 44.5, -12.5, 23.125},
          SpeakerItem{6, 27000.5, 1.25, 94.0},
          MeanItem{7, 25.5f, {1, 2, 3}, {0.1f, 0.2f, 0.3f}, {0, 0, 1}, 200},
          table,
          log,
          EventItem{12, EventItem::Kind::kStimulusBegin, 3, 27000, 94, "tone"},
          SnapshotItem{13, R"({"schema":1})"}};
}

inline std::vector<Item> ReadAll(const std::filesystem::path& path, ulog::End* end = nullptr) {
  std::vector<Item> items;
  const auto ended = ReadItems(path, [&](const Item& item) { items.push_back(item); });
  EXPECT_TRUE(ended.has_value()) << (ended ? "" : ended.error().message);
  if (end != nullptr && ended) *end = *ended;
  return items;
}

/// Equality of items is equality of what is packed.
inline std::string Bytes(const Item& item) {
  return std::visit(
      []<typename T>(const T& concrete) {
        if constexpr (std::is_same_v<T, SnapshotItem>) {
          return std::to_string(concrete.at_us) + concrete.json;
        } else {
          std::string bytes(kItemBytes<T>, '\0');
          PackItem(concrete, reinterpret_cast<std::uint8_t*>(bytes.data()));
          return std::string(ItemLayout<T>::kName) + bytes;
        }
      },
      item);
}
inline std::vector<std::string> Bytes(const std::vector<Item>& items) {
  std::vector<std::string> all;
  for (const Item& item : items) all.push_back(Bytes(item));
  return all;
}

inline void Record(const std::filesystem::path& path, const std::vector<Item>& items) {
  auto recorder = Recorder::Create(path, 77, {{"profile", "smoke"}});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  for (const Item& item : items) (*recorder)->Write(item);
  const Status closed = (*recorder)->Close();
  ASSERT_TRUE(closed.has_value()) << closed.error().message;
}

}  // namespace zrobench::testing
