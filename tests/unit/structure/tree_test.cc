// The rules, applied to every source of the checkout.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/unit/structure/source_rules.h"

namespace zrobench::structure {
namespace {

using Rule = std::vector<std::string> (*)(std::string_view, std::string_view);

int VisitTree(Rule rule, std::vector<std::string>* faults) {
  const std::filesystem::path root = ZROBENCH_SOURCE_DIR;
  int files = 0;
  for (const char* top : {"core", "corrector", "drivers", "rig", "dashboard", "tests"}) {
    if (!std::filesystem::exists(root / top)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
      const std::filesystem::path extension = entry.path().extension();
      if (extension != ".cc" && extension != ".h") continue;
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      const std::string path = entry.path().lexically_relative(root).generic_string();
      for (const std::string& fault : rule(path, text)) faults->push_back(fault);
      ++files;
    }
  }
  return files;
}

void ExpectClean(Rule rule) {
  std::vector<std::string> faults;
  EXPECT_GT(VisitTree(rule, &faults), 30) << "the tree was not found";
  EXPECT_THAT(faults, testing::IsEmpty());
}

TEST(Structure, RoomsIncludeOnlyWhomTheyMay) { ExpectClean(IncludeFaults); }
TEST(Structure, OnlyTheClockReadsClocks) { ExpectClean(ClockFaults); }
TEST(Structure, TheCorrectorIsFreestanding) { ExpectClean(FreestandingFaults); }
TEST(Structure, ASourceIncludesItsOwnHeaderFirst) { ExpectClean(OwnHeaderFaults); }
TEST(Structure, NoFileIsTooLong) { ExpectClean(LengthFaults); }

}  // namespace
}  // namespace zrobench::structure
