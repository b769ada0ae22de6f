#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/unit/record/record_fixture.h"

namespace zrobench::testing {
namespace {

class RecordTest : public FolderTest {};

TEST_F(RecordTest, EveryItemTypeComesBackAsItWentIn) {
  Record(Path("r.ulg"), OneOfEach());
  ulog::End end;
  const auto items = ReadAll(Path("r.ulg"), &end);
  EXPECT_EQ(Bytes(items), Bytes(OneOfEach()));
  EXPECT_EQ(std::get<TableItem>(items[7]).image, std::get<TableItem>(OneOfEach()[7]).image);
  EXPECT_EQ(std::get<EventItem>(items[9]).text, "tone");
  EXPECT_EQ(std::get<SnapshotItem>(items[10]).json, R"({"schema":1})");
  EXPECT_TRUE(end.whole);
  EXPECT_EQ(end.whole_bytes, std::filesystem::file_size(Path("r.ulg")));
}

TEST_F(RecordTest, InformationAndUnitsAreInTheFile) {
  Record(Path("r.ulg"), OneOfEach());
  auto reader = ItemReader::Open(Path("r.ulg"));
  ASSERT_TRUE(reader.has_value());
  reader->Drain([](const auto&) {});
  EXPECT_EQ(reader->start_us(), 77u);
  EXPECT_EQ(reader->info().at("sys_name"), "zrobench");
  EXPECT_EQ(reader->info().at("profile"), "smoke");
  EXPECT_EQ(reader->info().at("unit.rate_lsb"), "1/256 dps");
  EXPECT_EQ(reader->info().at("unit.plate_degc"), "degC");
}

TEST_F(RecordTest, SameItemsGiveTheSameBytes) {
  Record(Path("a.ulg"), OneOfEach());
  Record(Path("b.ulg"), OneOfEach());
  EXPECT_EQ(Read(Path("a.ulg")), Read(Path("b.ulg")));
}

TEST_F(RecordTest, AnHourOfSamplesStaysUnder45Megabytes) {
  const auto sample_bytes = kItemBytes<ImuSample> + 2 + ulog::kMessageHeaderBytes;
  EXPECT_EQ(sample_bytes, 35u);
  // Board traffic at 200 Hz: a time and a correction each 10th sample, a mean and 4 frames a
  // second.
  const auto each_second = 200 * sample_bytes + 20 * (kItemBytes<ImuTime> + 5) +
                           20 * (kItemBytes<ImuCorrection> + 5) + kItemBytes<MeanItem> + 5 +
                           4 * (kItemBytes<BusFrame> + 5);
  EXPECT_LT(each_second * 3600, 45'000'000u);
}

TEST_F(RecordTest, LongTextIsCutBetweenCharacters) {
  EventItem event;
  event.text = std::string(94, 'x') + "\u00B0C";  // the degree sign would straddle byte 95
  Record(Path("r.ulg"), {event});
  EXPECT_EQ(std::get<EventItem>(ReadAll(Path("r.ulg")).at(0)).text, std::string(94, 'x'));
}

TEST_F(RecordTest, ARecordIsNeverOverwritten) {
  Record(Path("r.ulg"), OneOfEach());
  const std::string before = Read(Path("r.ulg"));
  const auto again = Recorder::Create(Path("r.ulg"), 0, {});
  ASSERT_FALSE(again.has_value());
  EXPECT_EQ(again.error().kind, Error::Kind::kFile);
  EXPECT_NE(again.error().message.find("r.ulg"), std::string::npos);
  EXPECT_EQ(Read(Path("r.ulg")), before);
}

TEST_F(RecordTest, AMissingFolderIsSaidWithThePath) {
  const auto made = Recorder::Create(Path("no/such/r.ulg"), 0, {});
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("no/such/r.ulg"), std::string::npos);
}

TEST_F(RecordTest, AFullDiskIsAnErrorOfTheWorld) {
  const auto made = Recorder::Create("/dev/full", 0, {});
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().kind, Error::Kind::kFile);
  EXPECT_NE(made.error().message.find("/dev/full: cannot be written: No space left"),
            std::string::npos)
      << made.error().message;
}

// The file may grow to `limit` bytes only, as on a disk that fills up in the middle of a run.
int RecordUnderLimit(const std::filesystem::path& path, rlim_t limit) {
  ::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{limit, limit};
  ::setrlimit(RLIMIT_FSIZE, &small);
  auto recorder = Recorder::Create(path, 0, {});
  if (!recorder) return 1;
  for (int i = 0; i < 2000; ++i) (*recorder)->Write(ImuSample{static_cast<std::uint64_t>(i)});
  if ((*recorder)->status()) return 2;  // the error must stick
  if ((*recorder)->Flush()) return 3;
  if ((*recorder)->Close()) return 4;
  return (*recorder)->status().error().message.find(path.string()) == std::string::npos ? 5 : 0;
}

TEST_F(RecordTest, ADiskThatFillsUpLeavesWholeMessagesAndAStickyError) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(RecordUnderLimit(Path("r.ulg"), 20'011));
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  ulog::End end;
  const auto items = ReadAll(Path("r.ulg"), &end);
  EXPECT_TRUE(end.whole) << end.message;
  ASSERT_GT(items.size(), 100u);
  for (std::size_t i = 0; i < items.size(); ++i) {
    EXPECT_EQ(std::get<ImuSample>(items[i]).at_us, i);
  }
}

TEST_F(RecordTest, AMessageLargerThanABlockIsWrittenWhole) {
  const SnapshotItem large{5, std::string(50'000, 'j')};
  Record(Path("r.ulg"), {ImuSample{1}, large, ImuSample{2}});
  const auto items = ReadAll(Path("r.ulg"));
  ASSERT_EQ(items.size(), 3u);
  EXPECT_EQ(std::get<SnapshotItem>(items[1]).json, large.json);
  EXPECT_EQ(std::get<ImuSample>(items[2]).at_us, 2u);
}

TEST_F(RecordTest, AGrowingFileIsReadOnFromWhereItEnded) {
  auto recorder = Recorder::Create(Path("r.ulg"), 0, {});
  ASSERT_TRUE(recorder.has_value());
  auto reader = ItemReader::Open(Path("r.ulg"));
  ASSERT_TRUE(reader.has_value());
  std::vector<Item> seen;
  for (std::uint64_t i = 0; i < 3; ++i) {
    (*recorder)->Write(ImuSample{i});
    ASSERT_TRUE((*recorder)->Flush().has_value());
    reader->Drain([&](const Item& item) { seen.push_back(item); });
    ASSERT_EQ(seen.size(), i + 1);
    EXPECT_EQ(std::get<ImuSample>(seen.back()).at_us, i);
  }
}

}  // namespace
}  // namespace zrobench::testing
