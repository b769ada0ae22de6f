// Kills a process that records, at random instants: what had reached the kernel must be readable.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <random>
#include <thread>

#include "rig/record/item_reader.h"
#include "rig/record/recorder.h"

namespace zrobench {
namespace {

constexpr std::uint64_t kSampleBytes = 35;

/// The child: records samples for ever; tells through the pipe how many are surely written.
[[noreturn]] void RecordForEver(const std::filesystem::path& path, int pipe) {
  auto recorder = Recorder::Create(path, 0, {});
  if (!recorder) ::_exit(1);
  std::uint64_t written = (*recorder)->written_bytes();
  for (std::uint64_t n = 0;; ++n) {
    ImuSample sample;
    sample.at_us = n;
    sample.seq = static_cast<std::uint8_t>(n);
    (*recorder)->Write(sample);
    if (n % 1000 == 999) static_cast<void>((*recorder)->Flush());
    if ((*recorder)->written_bytes() == written) continue;
    written = (*recorder)->written_bytes();
    // A block is written when the next sample does not fit any more; after a flush nothing waits.
    const std::uint64_t flushed = n % 1000 == 999 ? n + 1 : n;
    if (::write(pipe, &flushed, sizeof flushed) != sizeof flushed) ::_exit(2);
  }
}

/// The last number the child told before it died.
std::uint64_t LastReport(int pipe) {
  std::uint64_t flushed = 0, report = 0;
  while (::read(pipe, &report, sizeof report) == sizeof report) flushed = report;
  return flushed;
}

std::uint64_t RecordAndKill(const std::filesystem::path& path, std::chrono::microseconds after) {
  int pipe[2];
  EXPECT_EQ(::pipe(pipe), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe[0]);
    RecordForEver(path, pipe[1]);
  }
  ::close(pipe[1]);
  std::uint64_t first = 0;
  EXPECT_EQ(::read(pipe[0], &first, sizeof first), ssize_t{sizeof first});
  // The reports are drained while the child runs: a full pipe would stop it between two writes.
  std::thread killer([&] {
    std::this_thread::sleep_for(after);
    ::kill(child, SIGKILL);
  });
  const std::uint64_t flushed = std::max(first, LastReport(pipe[0]));
  killer.join();
  ::close(pipe[0]);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  return flushed;
}

TEST(RecordCrashTest, AfterAKillEveryFlushedSampleIsReadable) {
  std::string name = (std::filesystem::temp_directory_path() / "zrobench-crash-XXXXXX").string();
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  const std::filesystem::path folder = name;
  std::mt19937 generator(20260101);
  std::uniform_int_distribution<int> after_us(0, 20'000);
  for (int round = 0; round < 20; ++round) {
    const auto path = folder / (std::to_string(round) + ".ulg");
    const std::uint64_t flushed =
        RecordAndKill(path, std::chrono::microseconds(after_us(generator)));
    std::uint64_t read = 0;
    const auto end = ReadItems(path, [&](const Item& item) {
      ASSERT_EQ(std::get<ImuSample>(item).at_us, read);
      ++read;
    });
    ASSERT_TRUE(end.has_value()) << end.error().message;
    EXPECT_GT(flushed, 0u);
    EXPECT_GE(read, flushed) << "round " << round << ": " << end->message;
    // No more than what was on its way: at most one block and the flush that was not yet told.
    EXPECT_LE(read, flushed + 2 * ulog::Writer::kBlockBytes / kSampleBytes);
    EXPECT_EQ(end->message.find("garbage"), std::string::npos) << end->message;
    std::filesystem::remove(path);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace zrobench
