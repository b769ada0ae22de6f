// Others must be able to read our records: Foxglove's own ULog reader gets the same numbers out of
// one as ours does. Wants npm, and once the package that package.json names; else it is skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "rig/record/item_reader.h"
#include "tests/e2e/program.h"

namespace zrobench {
namespace {

using testing::HasSubstr;

using Json = nlohmann::json;
namespace fs = std::filesystem;

const fs::path kHere = ZROBENCH_SOURCE_DIR "/tests/foxglove";
const fs::path kReader = ZROBENCH_NODE_FOLDER;

/// Copies the reader's files and installs its package; the reason where that cannot be done.
std::string Install() {
  if (std::string(ZROBENCH_NPM).empty() || std::string(ZROBENCH_NODE).empty()) {
    return "npm or node is not installed";
  }
  fs::create_directories(kReader);
  for (const char* file : {"package.json", "package-lock.json", "read.mjs"}) {
    fs::copy_file(kHere / file, kReader / file, fs::copy_options::overwrite_existing);
  }
  if (fs::exists(kReader / "node_modules/@foxglove/ulog/package.json")) return {};
  const ProgramResult npm =
      RunProgram(ZROBENCH_NPM, {"ci", "--no-audit", "--no-fund", "--ignore-scripts"}, kReader);
  // No network is no fault of ours; a lock file that does not fit, or bytes that it forbids, are.
  EXPECT_THAT(npm.err, testing::Not(testing::AnyOf(HasSubstr("EUSAGE"), HasSubstr("EINTEGRITY"))));
  return npm.exit_code == 0 ? "" : "npm cannot install @foxglove/ulog: " + npm.err;
}

struct OwnView {
  std::map<std::string, std::size_t> counts;
  std::array<long, 3> raw_sums{};
  ImuSample sample;
  ImuTime time;
  PlateItem plate;
  MeanItem mean;
  TableItem table;
};

OwnView ReadOurselves(const fs::path& record) {
  OwnView view;
  const auto end = ReadItems(record, [&]<typename T>(const T& item) {
    if constexpr (!std::is_same_v<T, SnapshotItem>) ++view.counts[ItemLayout<T>::kName];
    if constexpr (std::is_same_v<T, ImuSample>) {
      for (std::size_t axis = 0; axis < 3; ++axis) view.raw_sums[axis] += item.raw[axis];
      view.sample = item;
    }
    if constexpr (std::is_same_v<T, ImuTime>) view.time = item;
    if constexpr (std::is_same_v<T, PlateItem>) view.plate = item;
    if constexpr (std::is_same_v<T, MeanItem>) view.mean = item;
    if constexpr (std::is_same_v<T, TableItem>) view.table = item;
  });
  EXPECT_TRUE(end && end->whole);
  return view;
}

TEST(Foxglove, ReadsTheSameNumbersFromARecord) {
  if (const std::string missing = Install(); !missing.empty()) GTEST_SKIP() << missing;
  const TemporaryFolder folder;
  ASSERT_EQ(RunProgram(ZROBENCH_PROGRAM, {"run", "--ui", "none"}, folder.path()).exit_code, 0);
  const fs::path record = OnlyRun(folder.path()) / "record.ulg";
  const ProgramResult node =
      RunProgram(ZROBENCH_NODE, {(kReader / "read.mjs").string(), record.string()}, kReader);
  ASSERT_EQ(node.exit_code, 0) << node.err;
  const Json seen = Json::parse(node.out);
  const Json& topics = seen.at("topics");
  const OwnView ours = ReadOurselves(record);

  EXPECT_EQ(topics.size(), std::tuple_size_v<DataItems>);
  for (const auto& [name, count] : ours.counts) EXPECT_EQ(topics.at(name).at("count"), count);
  EXPECT_EQ(topics.at("imu_sample").at("sums"), Json(ours.raw_sums));
  const Json& sample = topics.at("imu_sample").at("last");
  EXPECT_EQ(sample.at("timestamp"), ours.sample.at_us);
  EXPECT_EQ(sample.at("accel_lsb"), Json(ours.sample.accel));
  EXPECT_EQ(sample.at("rate_lsb"), Json(ours.sample.rate));
  EXPECT_EQ(sample.at("rate_flags"), ours.sample.rate_flags);
  EXPECT_EQ(topics.at("imu_time").at("last").at("temperature_lsb"), ours.time.temperature);
  EXPECT_EQ(topics.at("plate").at("last").at("drive_pct"), ours.plate.drive_pct);
  EXPECT_EQ(topics.at("mean_1s").at("last").at("raw_dps"), Json(ours.mean.raw_dps));
  const Json& table = topics.at("corrector_table").at("last");
  EXPECT_EQ(table.at("image_length"), ours.table.image.size());
  EXPECT_EQ(table.at("image").get<std::vector<int>>().at(2), ours.table.image.at(2));
  for (const auto& [field, unit] : ItemUnits())
    EXPECT_EQ(seen.at("units").at("unit." + field), unit);
}

}  // namespace
}  // namespace zrobench
