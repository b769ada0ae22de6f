// Two programs started at the same moment in one folder: each has a run of its own, whole.
#include <gtest/gtest.h>

#include <set>

#include "rig/record/item_reader.h"
#include "tests/e2e/program.h"

namespace zrobench {
namespace {

namespace fs = std::filesystem;

/// How many samples a record holds; it must be whole.
std::size_t WholeSamples(const fs::path& record) {
  std::size_t samples = 0;
  const auto end = ReadItems(
      record, [&]<typename T>(const T&) { samples += std::is_same_v<T, ImuSample> ? 1 : 0; });
  EXPECT_TRUE(end && end->whole) << record;
  return samples;
}

TEST(SideBySide, RunsStartedTogetherInOneFolderLoseNothing) {
  const TemporaryFolder shared, first_output, second_output, alone;
  const fs::path runs = shared.path() / "runs";  // neither may find it there already
  const std::vector<std::string> arguments = {"run", "--ui", "none", "--runs", runs.string()};
  Program first(ZROBENCH_PROGRAM, arguments, first_output.path());
  Program second(ZROBENCH_PROGRAM, arguments, second_output.path());
  EXPECT_EQ(first.Wait().exit_code, 0);
  EXPECT_EQ(second.Wait().exit_code, 0);
  ASSERT_EQ(RunProgram(ZROBENCH_PROGRAM, {"run", "--ui", "none"}, alone.path()).exit_code, 0);
  const fs::path reference = OnlyRun(alone.path()) / "record.ulg";
  const std::size_t samples = WholeSamples(reference);
  EXPECT_GT(samples, 100'000u);

  std::set<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(runs)) folders.insert(entry.path());
  ASSERT_EQ(folders.size(), 2u);
  for (const fs::path& run : folders) {
    EXPECT_EQ(WholeSamples(run / "record.ulg"), samples);
    EXPECT_TRUE(ReadText(run / "record.ulg") == ReadText(reference)) << run;
    for (const char* file : {"run.json", "report.html", "report.txt", "junit.xml"}) {
      EXPECT_GT(fs::file_size(run / file), 100u) << run / file;
    }
  }
}

}  // namespace
}  // namespace zrobench
