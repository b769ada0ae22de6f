#include "rig/diagnose/case.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/unit/diagnose/bench_recording.h"

namespace zrobench::diagnose {
namespace {

using testing::HasSubstr;

class CaseFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("zrobench-case-" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(CaseFolder, AFolderGivesWhatWasWritten) {
  BenchRecording recording;
  recording.seconds = 60;
  const Case made = recording.Make();
  Write(made, folder_);
  const auto loaded = LoadCase(folder_);
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  ASSERT_EQ(loaded->runs.size(), 2u);
  EXPECT_EQ(loaded->runs[1].name, "run-2");
  EXPECT_EQ(loaded->runs[1].started_h, 26.0);
  ASSERT_EQ(loaded->runs[0].rows.size(), 60u);
  EXPECT_NEAR(loaded->runs[0].rows[30][Channel::kGyroX], made.runs[0].rows[30][Channel::kGyroX],
              1e-6);
  EXPECT_TRUE(loaded->Has(Channel::kDrive));
  EXPECT_FALSE(loaded->Has(Channel::kToneHz));
}

TEST_F(CaseFolder, WhatIsMissingIsSaid) {
  auto loaded = LoadCase(folder_ / "nowhere");
  ASSERT_FALSE(loaded.has_value());
  EXPECT_THAT(loaded.error().message, HasSubstr("station.toml"));
  std::ofstream(folder_ / "station.toml") << "schema = 1\n[station]\nname = \"b\"\n";
  loaded = LoadCase(folder_);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_THAT(loaded.error().message, HasSubstr("run-1.csv"));
}

TEST_F(CaseFolder, ABrokenRecordingIsRefusedWithItsLine) {
  std::ofstream(folder_ / "station.toml") << "schema = 1\n[station]\nname = \"b\"\n";
  std::ofstream(folder_ / "run-1.csv") << "t_s,imu_degc\n0,20\n2,20\n1,20\n";
  const auto loaded = LoadCase(folder_);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_EQ(loaded.error().kind, Error::Kind::kConfig);
  EXPECT_THAT(loaded.error().message, HasSubstr("run-1.csv:4"));
}

TEST_F(CaseFolder, RecordingSettingsAreChecked) {
  std::ofstream(folder_ / "station.toml")
      << "schema = 1\n[station]\nname = \"b\"\n[recording]\nrows = \"average\"\nrow = 3\n";
  const auto loaded = LoadCase(folder_);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_THAT(loaded.error().message, HasSubstr("average"));
  EXPECT_THAT(loaded.error().message, HasSubstr("row"));
}

}  // namespace
}  // namespace zrobench::diagnose
