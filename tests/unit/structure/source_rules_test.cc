// The rules catch what they are there for: each is fed planted violations.
#include "tests/unit/structure/source_rules.h"

#include <gmock/gmock.h>

namespace zrobench::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(SourceRules, CommentsAndQuotationsAreGoneLinesStay) {
  EXPECT_EQ(WithoutComments("a // b\nc /* d\n e */ f \"g // \\\" h\" i\n"), "a \nc \n f  i\n");
  EXPECT_EQ(WithoutComments("#include \"core/clock.h\"  // why\n"),
            "#include \"core/clock.h\"  \n");
  EXPECT_EQ(WithoutComments("x R\"(double\nnew)\" y"), "x \n y");
  EXPECT_EQ(WithoutComments("/* open"), "");
}

TEST(SourceRules, TheInnermostRoomCounts) {
  EXPECT_EQ(RoomOf("corrector/node/node.h"), "corrector/node");
  EXPECT_EQ(RoomOf("corrector/table.h"), "corrector");
  EXPECT_EQ(RoomOf("rig/physics/terms/x.cc"), "rig/physics");
  EXPECT_EQ(RoomOf("tests/unit/core/clock_test.cc"), "");
}

TEST(SourceRules, AForbiddenIncludeIsCaughtWithItsLine) {
  EXPECT_THAT(IncludeFaults("corrector/table.cc",
                            "#include \"corrector/table.h\"\n#include \"core/units.h\"\n"),
              ElementsAre("corrector/table.cc:2: corrector may not include core/units.h"));
  EXPECT_THAT(IncludeFaults("corrector/table.cc", "#include \"corrector/node/node.h\"\n"),
              SizeIs(1));
  EXPECT_THAT(IncludeFaults("core/clock.cc", "#include \"rig/station/station.h\"\n"), SizeIs(1));
  EXPECT_THAT(IncludeFaults("rig/physics/a.cc", "#include \"rig/station/station.h\"\n"), SizeIs(1));
  EXPECT_THAT(IncludeFaults("rig/run/a.cc", "  #  include \"rig/virtual/plate.h\"\n"), SizeIs(1));
  EXPECT_THAT(IncludeFaults("rig/report/a.cc", "#include \"rig/run/check.h\"\n"), SizeIs(1));
  EXPECT_THAT(IncludeFaults("drivers/imu/a.cc", "#include \"rig/physics/model.h\"\n"), SizeIs(1));
}

TEST(SourceRules, NobodyIncludesTheCommandLine) {
  EXPECT_THAT(IncludeFaults("rig/run/a.cc", "#include \"rig/cli/run.h\"\n"), SizeIs(1));
  EXPECT_THAT(IncludeFaults("tests/unit/run/a.cc", "#include \"rig/cli/run.h\"\n"), SizeIs(1));
  EXPECT_THAT(IncludeFaults("rig/cli/main.cc", "#include \"rig/cli/run.h\"\n"), IsEmpty());
}

TEST(SourceRules, IncludesAreRootedAtTheRepository) {
  EXPECT_THAT(IncludeFaults("core/clock.cc", "#include \"clock.h\"\n"),
              ElementsAre(HasSubstr("not rooted")));
  EXPECT_THAT(IncludeFaults("rig/run/a.cc", "#include \"tests/x.h\"\n"), SizeIs(1));
}

TEST(SourceRules, AllowedIncludesPass) {
  EXPECT_THAT(IncludeFaults("rig/virtual/a.cc",
                            "#include \"core/clock.h\"\n#include \"rig/physics/model.h\"\n"
                            "#include \"drivers/imu/imu_board.h\"\n"
                            "#include \"corrector/node/node.h\"\n#include <vector>\n"),
              IsEmpty());
  EXPECT_THAT(IncludeFaults("corrector/a.cc", "// #include \"core/units.h\"\n"), IsEmpty());
}

TEST(SourceRules, OnlyTheClockReadsClocks) {
  const std::string sleep = "int a;\nstd::this_thread::sleep_for(1s);\n";
  EXPECT_THAT(ClockFaults("rig/run/a.cc", sleep), ElementsAre(HasSubstr("rig/run/a.cc:2:")));
  EXPECT_THAT(ClockFaults("rig/run/a.cc", "auto t = std::chrono::steady_clock::now();"), SizeIs(1));
  EXPECT_THAT(ClockFaults("core/clock.cc", sleep), IsEmpty());
  EXPECT_THAT(ClockFaults("rig/run/a.cc", "// never sleep_for\n"), IsEmpty());
}

TEST(SourceRules, TheCorrectorIsFreestanding) {
  EXPECT_THAT(FreestandingFaults("corrector/a.cc", "#include <vector>\n"), SizeIs(1));
  EXPECT_THAT(FreestandingFaults("corrector/node/a.cc", "#include <string>\n"), SizeIs(1));
  EXPECT_THAT(FreestandingFaults("corrector/a.cc", "double x;\nfloat y;\n"),
              ElementsAre(HasSubstr("corrector/a.cc:1: double")));
  EXPECT_THAT(FreestandingFaults("corrector/a.cc", "auto* p = new int;\n"), SizeIs(1));
  EXPECT_THAT(FreestandingFaults("corrector/a.cc", "#include <new>\nnew (place) int;\n"),
              IsEmpty());  // in place: no heap
  EXPECT_THAT(FreestandingFaults("corrector/a.cc",
                                 "A(const A&) = delete;\n#include <cmath>\n"
                                 "// a new, double entry\n"),
              IsEmpty());
  EXPECT_THAT(FreestandingFaults("rig/run/a.cc", "double x;\n"), IsEmpty());
}

TEST(SourceRules, FilesStayShort) {
  EXPECT_THAT(LengthFaults("a.cc", std::string(400, '\n')), IsEmpty());
  EXPECT_THAT(LengthFaults("a.cc", std::string(401, '\n')), SizeIs(1));
}

TEST(SourceRules, ASourceIncludesItsOwnHeaderFirst) {
  EXPECT_THAT(OwnHeaderFaults("rig/run/a.cc", "#include <vector>\n#include \"rig/run/a.h\"\n"),
              ElementsAre("rig/run/a.cc:2: not the first: rig/run/a.h"));
  EXPECT_THAT(OwnHeaderFaults("rig/run/a.cc", "#include \"rig/run/a.h\"\n#include <vector>\n"),
              IsEmpty());
  EXPECT_THAT(OwnHeaderFaults("rig/run/a.cc", "#include <vector>\n"), IsEmpty());
}

}  // namespace
}  // namespace zrobench::structure
