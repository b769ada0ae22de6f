#include <algorithm>

#include "tests/unit/record/record_fixture.h"

namespace zrobench::testing {
namespace {

class UlogTest : public FolderTest {
 protected:
  /// A file made by someone else: the caller adds formats and messages.
  std::unique_ptr<ulog::Writer> Foreign() const {
    auto writer = ulog::Writer::Create(Path("f.ulg"), 0);
    EXPECT_TRUE(writer.has_value());
    return std::move(*writer);
  }
};

TEST_F(UlogTest, CutAtAnyByteGivesEveryWholeMessageInFrontOfIt) {
  Record(Path("r.ulg"), OneOfEach());
  const std::string whole = Read(Path("r.ulg"));
  // Where each item's message ends, found by reading the file message by message.
  std::vector<std::uint64_t> ends;
  auto reader = ulog::Reader::Open(Path("r.ulg"));
  ASSERT_TRUE(reader.has_value());
  while (const auto message = reader->Next()) {
    if (message->type == 'D' || message->type == 'L') ends.push_back(reader->end().whole_bytes);
  }
  ASSERT_EQ(ends.size(), OneOfEach().size());
  const auto bytes = Bytes(OneOfEach());
  for (std::size_t cut = whole.size(); cut >= ulog::kHeaderBytes; --cut) {
    std::filesystem::resize_file(Path("r.ulg"), cut);
    ulog::End end;
    const auto items = ReadAll(Path("r.ulg"), &end);
    const auto expected = static_cast<std::size_t>(
        std::count_if(ends.begin(), ends.end(), [&](std::uint64_t at) { return at <= cut; }));
    ASSERT_EQ(items.size(), expected) << "cut at " << cut;
    ASSERT_TRUE(
        std::equal(items.begin(), items.end(), bytes.begin(),
                   [](const Item& item, const std::string& b) { return Bytes(item) == b; }));
    ASSERT_LE(end.whole_bytes, cut);
    ASSERT_EQ(end.whole, end.whole_bytes == cut);
    ASSERT_EQ(end.whole, end.message.empty());
  }
}

TEST_F(UlogTest, TooShortOrForeignFilesAreRefused) {
  for (const std::string& bytes : {std::string(), std::string("ULog"), std::string(100, 'x')}) {
    const auto end = ReadItems(Write("x.ulg", bytes), [](const Item&) {});
    ASSERT_FALSE(end.has_value());
    EXPECT_EQ(end.error().kind, Error::Kind::kFile);
    EXPECT_NE(end.error().message.find("x.ulg"), std::string::npos);
  }
  EXPECT_FALSE(ReadItems(Path("absent.ulg"), [](const Item&) {}).has_value());
}

TEST_F(UlogTest, GarbageEndsTheReadingAndSaysWhere) {
  Record(Path("r.ulg"), OneOfEach());
  const std::string good = Read(Path("r.ulg"));
  for (const std::string& garbage : {std::string(64, '\0'), std::string("\x05\x00z12345", 8),
                                     std::string("\x02\x00"
                                                 "D\xFF\x01",
                                                 5),
                                     std::string("\x04\x00"
                                                 "D\x00\x00zz",
                                                 7),
                                     std::string("\x08\x00S12345678", 11)}) {
    ulog::End end;
    const auto items = ReadAll(Write("g.ulg", good + garbage + good.substr(16)), &end);
    EXPECT_EQ(Bytes(items), Bytes(OneOfEach()));
    EXPECT_FALSE(end.whole);
    EXPECT_EQ(end.whole_bytes, good.size());
    EXPECT_NE(end.message.find("byte " + std::to_string(good.size()) + ": garbage"),
              std::string::npos)
        << end.message;
  }
}

TEST_F(UlogTest, AnyDamagedByteLeavesWhatLiesInFrontOfIt) {
  const std::vector<Item> items = {ImuSample{1}, BusFrame{2}, PlateItem{3}};
  Record(Path("r.ulg"), items);
  const std::string good = Read(Path("r.ulg"));
  std::vector<std::uint64_t> ends;
  auto reader = ulog::Reader::Open(Path("r.ulg"));
  ASSERT_TRUE(reader.has_value());
  while (const auto message = reader->Next()) {
    if (message->type == 'D') ends.push_back(reader->end().whole_bytes);
  }
  const auto bytes = Bytes(items);
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (at % 2 ? 0xFF : 0x01));
    std::vector<std::string> seen;
    const auto end =
        ReadItems(Write("d.ulg", bad), [&](const Item& item) { seen.push_back(Bytes(item)); });
    if (!end) continue;
    EXPECT_LE(end->whole_bytes, bad.size());
    for (std::size_t i = 0; i < ends.size() && ends[i] <= at; ++i) {
      ASSERT_GT(seen.size(), i) << "byte " << at;
      ASSERT_EQ(seen[i], bytes[i]);
    }
  }
}

TEST_F(UlogTest, UnknownMessageTypesAreSkipped) {
  Record(Path("r.ulg"), {ImuSample{1}});
  const std::string good = Read(Path("r.ulg"));
  const std::string unknown = std::string("\x03\x00Zabc", 6) + std::string("\x02\x00O\x05\x00", 5);
  const std::string sample = good.substr(good.size() - 35);
  ulog::End end;
  const auto items = ReadAll(Write("u.ulg", good + unknown + sample), &end);
  EXPECT_EQ(items.size(), 2u);
  EXPECT_TRUE(end.whole) << end.message;
}

TEST_F(UlogTest, AForeignWritersFormatsAreSkippedWhole) {
  auto writer = Foreign();
  writer->Format("vehicle_status:uint64_t timestamp;other_type nested;");
  writer->Subscribe(5, "vehicle_status");
  std::fill_n(writer->Reserve(5, 11), 11, std::uint8_t{1});
  writer->Text('6', 3, "hello");
  writer->Format(ItemFormats()[1]);
  writer->Subscribe(900, "imu_time");
  PackItem(ImuTime{9, 8, 7, 6}, writer->Reserve(900, kItemBytes<ImuTime>));
  ASSERT_TRUE(writer->Close().has_value());
  ulog::End end;
  const auto items = ReadAll(Path("f.ulg"), &end);
  ASSERT_EQ(items.size(), 1u) << end.message;
  EXPECT_EQ(std::get<ImuTime>(items[0]).counter, 7);
  EXPECT_TRUE(end.whole) << end.message;
}

TEST_F(UlogTest, FieldsAreFoundByTheFilesOwnDefinitions) {
  auto writer = Foreign();
  // Another version: another order, a field more, `temperature_lsb` missing, `counter` another
  // type.
  writer->Format("imu_time:uint32_t device_us;float extra;uint64_t timestamp;uint32_t counter;");
  writer->Format("imu_correction:uint64_t timestamp;uint8_t state;");
  writer->Subscribe(0, "imu_time");
  writer->Subscribe(1, "imu_correction");
  std::uint8_t* at = writer->Reserve(0, 20);
  const std::uint32_t device_us = 123456;
  const std::uint64_t at_us = 42;
  std::memset(at, 0xEE, 20);
  std::memcpy(at, &device_us, 4);
  std::memcpy(at + 8, &at_us, 8);
  at = writer->Reserve(1, 9);
  std::memcpy(at, &at_us, 8);
  at[8] = 3;
  ASSERT_TRUE(writer->Close().has_value());
  const auto items = ReadAll(Path("f.ulg"));
  ASSERT_EQ(items.size(), 2u);
  const auto& time = std::get<ImuTime>(items[0]);
  EXPECT_EQ(time.at_us, 42u);
  EXPECT_EQ(time.device_us, 123456u);
  EXPECT_EQ(time.counter, 0);
  EXPECT_EQ(time.temperature, 0);
  const auto& correction = std::get<ImuCorrection>(items[1]);
  EXPECT_EQ(correction.state, 3);
  EXPECT_EQ(correction.bin, zro::kNoBin);  // a missing field keeps its default
}

TEST(UlogFormatTest, ParsesWhatTheRecorderDefines) {
  const auto format = ulog::ParseFormat(ItemFormats()[0]);
  ASSERT_TRUE(format.has_value());
  EXPECT_EQ(format->name, "imu_sample");
  EXPECT_EQ(format->bytes, kItemBytes<ImuSample>);
  EXPECT_EQ(format->fields[1].name, "raw_lsb");
  EXPECT_EQ(format->fields[1].type, "int16_t");
  EXPECT_EQ(format->fields[1].count, 3u);
  EXPECT_EQ(format->fields[1].offset, 8u);
}

TEST(UlogFormatTest, MalformedFormatsAreNone) {
  for (const char* text : {"", ":", "a", "a:float", "a:float ;", "a:float[x] b;", "a:float[2 b;",
                           "a:float[70000] b;", "a:other b;", "a:float[0] b;", "a:float[-1] b;"}) {
    EXPECT_FALSE(ulog::ParseFormat(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace zrobench::testing
