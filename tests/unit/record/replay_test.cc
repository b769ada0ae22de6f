#include "rig/record/replay/replay.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>

#include "rig/record/utc_text.h"
#include "tests/unit/record/record_fixture.h"

namespace zrobench::testing {
namespace {

constexpr double kSampleHz = 100;
constexpr double kNoiseDps = 0.03;

/// A gyro at rest whose offset is linear in temperature: x = 0.5 + 0.02 (T - 20), y = -1, z = 0.
struct Bench {
  std::mt19937 generator{1};
  std::normal_distribution<double> noise{0, 1};
  std::ostringstream csv;

  Bench() {
    csv << "t_s,imu_degc,gyro_x_dps,gyro_y_dps,gyro_z_dps,accel_x_g,accel_y_g,accel_z_g\n";
  }
  void Row(double t_s, double degc, bool temperature = true) {
    csv << t_s << ',';
    if (temperature) csv << degc;
    csv << ',' << 0.5 + 0.02 * (degc - 20) + kNoiseDps * noise(generator) << ','
        << -1 + kNoiseDps * noise(generator) << ',' << kNoiseDps * noise(generator) << ','
        << 1e-3 * noise(generator) << ",0," << 1 + 1e-3 * noise(generator) << '\n';
  }
  /// Rest from `from_s` to `to_s`, warming from 20 degC at 0.05 degC/s.
  Bench& Rest(double from_s, double to_s) {
    const auto count = std::lround((to_s - from_s) * kSampleHz);
    for (long i = 0; i < count; ++i) {
      const double t_s = from_s + static_cast<double>(i) / kSampleHz;
      Row(t_s, 20 + 0.05 * t_s);
    }
    return *this;
  }
};

class ReplayTest : public FolderTest {
 protected:
  ReplaySummary Run(const std::string& csv, const ReplayOptions& options = {}) const {
    auto summary = Replay(Write("in.csv", csv), options);
    EXPECT_TRUE(summary.has_value()) << (summary ? "" : summary.error().message);
    return summary ? *summary : ReplaySummary{};
  }
  std::string Refusal(const std::string& csv) const {
    const auto summary = Replay(Write("in.csv", csv), {});
    if (summary) return "";
    EXPECT_EQ(summary.error().kind, Error::Kind::kConfig);
    return summary.error().message;
  }
  static std::vector<std::vector<std::string>> Table(const std::filesystem::path& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream in(Read(csv));
    for (std::string line; std::getline(in, line);) {
      auto& fields = rows.emplace_back(1);
      for (char c : line) {
        if (c == ',') {
          fields.emplace_back();
        } else {
          fields.back() += c;
        }
      }
    }
    return rows;
  }
};

TEST_F(ReplayTest, LearnsTheOffsetOfARestingGyroAndBeatsOneConstant) {
  const auto summary = Run(Bench().Rest(0, 400).csv.str());
  EXPECT_EQ(summary.samples, 40000u);
  EXPECT_NEAR(summary.duration_s, 399.99, 1e-6);
  EXPECT_EQ(summary.gaps, 0u);
  EXPECT_NEAR(summary.config.sample_hz, 100, 1e-3);
  EXPECT_EQ(summary.config.limits.min_samples, 500);
  EXPECT_TRUE(summary.noise_from_data);
  EXPECT_NEAR(summary.config.gyro_noise_density_dps_per_rthz, kNoiseDps * std::sqrt(2 / kSampleHz),
              0.1 * kNoiseDps * std::sqrt(2 / kSampleHz));
  ASSERT_GE(summary.final_table.size(), 5);
  for (int i = 0; i < summary.final_table.size(); ++i) {
    const zro::Entry& entry = summary.final_table[i];
    EXPECT_NEAR(entry.zro_dps[0], 0.5 + 0.02 * (double{entry.temp_degc} - 20), 0.012);
    EXPECT_NEAR(entry.zro_dps[1], -1, 0.012);
  }
  EXPECT_GE(summary.errors.readings(), 5u);
  EXPECT_GT(summary.errors.constant_rms_mdps(0), 150);  // 20 K at 20 mdps/K
  EXPECT_LT(summary.errors.corrector_rms_mdps(0), 0.5 * summary.errors.constant_rms_mdps(0));
  EXPECT_LT(summary.errors.constant_rms_mdps(1), 12);
}

constexpr const char* kBurstMap =
    "schema = 1\nname = \"bursts\"\n[csv]\n%RATE%[channel]\nt_s = { column = \"t_s\" }\n"
    "imu_degc = { column = \"imu_degc\" }\ngyro_x_dps = { column = \"gyro_x_dps\" }\n"
    "gyro_y_dps = { column = \"gyro_y_dps\" }\ngyro_z_dps = { column = \"gyro_z_dps\" }\n"
    "accel_x_g = { column = \"accel_x_g\" }\naccel_y_g = { column = \"accel_y_g\" }\n"
    "accel_z_g = { column = \"accel_z_g\" }\n";

TEST_F(ReplayTest, AStatedRateCountsRowsThatComeInBurstsAndStillSeesAGap) {
  Bench bench;
  for (int i = 0; i < 6000; ++i) {  // ten rows at once, every 0.1 s; 20 s are missing in the middle
    const double sent_s = 0.1 * (i / 10) + 0.001 * (i % 10) + (i < 3000 ? 0.0 : 20.0);
    bench.Row(sent_s, 25);
  }
  const auto replay = [&](const std::string& rate) {
    std::string map = kBurstMap;
    map.replace(map.find("%RATE%"), 6, rate);
    ReplayOptions options;
    options.map = Write("map.toml", map);
    return Run(bench.csv.str(), options);
  };
  const ReplaySummary counted = replay("sample_hz = 100\n");
  EXPECT_EQ(counted.gaps, 1u);
  EXPECT_NEAR(counted.config.sample_hz, 100, 1e-3);
  EXPECT_EQ(counted.final_table.size(), 1);
  const ReplaySummary stamped = replay("");  // the stamps alone say 1 kHz with holes
  EXPECT_GT(stamped.gaps, 100u);
  EXPECT_EQ(stamped.final_table.size(), 0);
}

TEST(HindsightTest, APolynomialLeavesWhatItsDegreeCannotTake) {
  Hindsight hindsight;
  for (int i = 0; i <= 10; ++i) {
    const double t = i - 5;
    const float reading[3] = {0.25f, static_cast<float>(0.5 + 0.125 * t),
                              static_cast<float>(t * t * t)};
    hindsight.Add(20 + t, reading);
  }
  EXPECT_NEAR(hindsight.rms_mdps(0, 0), 0, 1e-9);
  EXPECT_NEAR(hindsight.rms_mdps(1, 0), 125 * std::sqrt(10.0), 1e-6);
  EXPECT_NEAR(hindsight.rms_mdps(1, 1), 0, 1e-6);
  // t^3 against t over -5 .. 5: slope 17.8, so t^3 - 17.8 t remains.
  double squares = 0;
  for (int t = -5; t <= 5; ++t) squares += std::pow(t * t * t - 17.8 * t, 2);
  EXPECT_NEAR(hindsight.rms_mdps(2, 1), 1e3 * std::sqrt(squares / 11), 1e-3);
  EXPECT_NEAR(hindsight.rms_mdps(2, 3), 0, 1e-3);
}

TEST(HindsightTest, TooFewReadingsSayNothing) {
  Hindsight hindsight;
  const float reading[3] = {1, 2, 3};
  hindsight.Add(20, reading);
  EXPECT_EQ(hindsight.rms_mdps(0, 1), 0);
}

TEST(ErrorTableTest, TheErrorIsThatOfTheEstimateBeforeTheReading) {
  ErrorTable errors;
  const float zero[3] = {}, first[3] = {1, 2, 3}, second[3] = {1.5f, 2, 3}, third[3] = {2, 2, 2};
  errors.Add(first, zero);
  EXPECT_EQ(errors.corrector_rms_mdps(0), 0);
  errors.Add(second, first);
  errors.Add(third, second);
  EXPECT_EQ(errors.readings(), 3u);
  EXPECT_NEAR(errors.corrector_rms_mdps(0), 500, 1e-3);
  EXPECT_NEAR(errors.constant_rms_mdps(0), 1e3 * std::sqrt((0.25 + 1) / 2), 1e-3);
  EXPECT_NEAR(errors.constant_max_mdps(0), 1000, 1e-3);
  EXPECT_NEAR(errors.corrector_max_mdps(2), 1000, 1e-3);
  EXPECT_NEAR(errors.corrector_rms_mdps(1), 0, 1e-9);
}

TEST_F(ReplayTest, WritesEstimatesDecisionsAndTable) {
  ReplayOptions options;
  options.estimates = Path("e.csv");
  options.decisions = Path("d.csv");
  options.table = Path("t.csv");
  options.start = ParseUtc("2026-01-01");
  const auto summary = Run(Bench().Rest(0, 60).csv.str(), options);
  const auto e = Table(Path("e.csv")), d = Table(Path("d.csv")), t = Table(Path("t.csv"));
  EXPECT_EQ(e[0], (std::vector<std::string>{"t_s", "zro_x_dps", "zro_y_dps", "zro_z_dps", "still",
                                            "updated"}));
  ASSERT_EQ(e.size(), 1 + summary.samples);
  EXPECT_EQ(d[0], (std::vector<std::string>{"t_s", "code", "temp_degc", "zro_x_dps", "zro_y_dps",
                                            "zro_z_dps", "wrote", "entry"}));
  ASSERT_GE(d.size(), 2u);
  EXPECT_EQ(d[1][1], "32");
  EXPECT_EQ(d[1][6], "1");
  EXPECT_EQ(d[1][7], "0");
  // Each written decision is an `updated` sample, and no other sample is.
  std::vector<std::string> updated, wrote;
  for (const auto& row : e) {
    if (row[5] == "1") updated.push_back(row[0]);
  }
  for (const auto& row : d) {
    if (row[6] == "1") wrote.push_back(row[0]);
  }
  EXPECT_EQ(updated, wrote);
  ASSERT_EQ(t.size(), static_cast<std::size_t>(summary.final_table.size()) + 1);
  EXPECT_EQ(t[1][4], "2026-01-01");
  EXPECT_EQ(t[1][8], "learned");
}

TEST_F(ReplayTest, ErrorsAreThoseOfTheSampleBeforeTheReadingEntered) {
  ReplayOptions options;
  options.estimates = Path("e.csv");
  options.decisions = Path("d.csv");
  const auto summary = Run(Bench().Rest(0, 200).csv.str(), options);
  const auto e = Table(Path("e.csv")), d = Table(Path("d.csv"));
  double squares = 0;
  int readings = 0;
  for (std::size_t i = 1; i < d.size(); ++i) {
    if (d[i][6] != "1" || ++readings == 1) continue;
    const auto at =
        std::find_if(e.begin() + 1, e.end(), [&](const auto& row) { return row[0] == d[i][0]; });
    ASSERT_NE(at, e.end());
    squares += std::pow(1e3 * (std::stod(d[i][3]) - std::stod((*(at - 1))[1])), 2);
  }
  ASSERT_GE(readings, 3);
  EXPECT_EQ(summary.errors.readings(), static_cast<std::uint64_t>(readings));
  EXPECT_NEAR(summary.errors.corrector_rms_mdps(0), std::sqrt(squares / (readings - 1)), 1e-3);
}

TEST_F(ReplayTest, FactoryEntriesAreThereFromTheFirstSample) {
  ReplayOptions options;
  options.estimates = Path("e.csv");
  options.factory = Write("f.csv",
                          "temp_degc, zro_x_dps, zro_y_dps, zro_z_dps\n"
                          "10,0.3,-1,0\n40,0.9,-1,0\n");
  Run(Bench().Rest(0, 1).csv.str(), options);
  const auto e = Table(Path("e.csv"));
  EXPECT_NEAR(std::stod(e.at(1).at(1)), 0.5, 1e-4);
  EXPECT_NEAR(std::stod(e.at(1).at(2)), -1, 1e-4);
}

TEST_F(ReplayTest, ABrokenFactoryFileIsPlaced) {
  ReplayOptions options;
  options.factory = Write("f.csv", "temp_degc,zro_x_dps,zro_y_dps,zro_z_dps\n10,0.3,x,0\n");
  const auto summary = Replay(Write("in.csv", Bench().Rest(0, 1).csv.str()), options);
  ASSERT_FALSE(summary.has_value());
  EXPECT_EQ(summary.error().kind, Error::Kind::kConfig);
  EXPECT_NE(summary.error().message.find("f.csv:2: error: zro_y_dps"), std::string::npos)
      << summary.error().message;
}

// The first reading is written some 6 s after the start and committed soon after it.
TEST_F(ReplayTest, AnOrderlyRebootKeepsTheTableAndACutLosesWhatIsNotCommitted) {
  const std::string csv = Bench().Rest(0, 20).csv.str();
  ReplayOptions options;
  options.decisions = Path("d.csv");
  Run(csv, options);
  const double written_s = std::stod(Table(Path("d.csv")).at(1).at(0));
  ASSERT_LT(written_s, 12);
  const auto entries_after = [&](bool orderly) {
    ReplayOptions boot;
    boot.estimates = Path("e.csv");
    (orderly ? boot.reboot_at_s : boot.cut_at_s) = {written_s + 0.05};
    Run(csv, boot);
    const auto e = Table(Path("e.csv"));
    const auto row = static_cast<std::size_t>((written_s + 0.1) * kSampleHz) + 1;
    return std::stod(e.at(row).at(2));  // y offset subtracted just after the boot
  };
  EXPECT_NEAR(entries_after(true), -1, 0.05);
  EXPECT_EQ(entries_after(false), 0);
}

TEST_F(ReplayTest, GapsAreToldFromJitter) {
  Bench bench;
  double t_s = 0;
  for (int i = 0; i < 3000; ++i) {
    bench.Row(t_s, 20);
    t_s += i % 2 ? 0.008 : 0.012;
    if (i == 1000 || i == 2000) t_s += 3;
  }
  EXPECT_EQ(Run(bench.csv.str()).gaps, 2u);
}

TEST_F(ReplayTest, TheSequenceCounterTellsSingleLosses) {
  std::string csv =
      "t_s,seq,imu_degc,gyro_x_dps,gyro_y_dps,gyro_z_dps,accel_x_g,accel_y_g,accel_z_g\n";
  for (int i = 0; i < 500; ++i) {
    if (i == 100) continue;
    csv += std::to_string(i * 0.01) + ',' + std::to_string(i) + ",20,1,1,1,0,0,1\n";
  }
  EXPECT_EQ(Run(csv).gaps, 1u);
}

TEST_F(ReplayTest, ABlankTemperatureHoldsFiveSecondsAndNoLonger) {
  // 1 Hz temperatures are as good as 100 Hz ones; without any after 8 s nothing more is learned.
  Bench sparse, silent;
  for (int i = 0; i < 6000; ++i) {
    sparse.Row(i / kSampleHz, 20, i % 100 == 0);
    silent.Row(i / kSampleHz, 20, i == 0);
  }
  const auto learned = Run(sparse.csv.str());
  EXPECT_GE(learned.decisions.count(zro::Code::kNew), 1u);
  EXPECT_EQ(learned.decisions.count(zro::Code::kTemperatureSensor), 0u);
  const auto refused = Run(silent.csv.str());
  EXPECT_GE(refused.decisions.count(zro::Code::kTemperatureSensor), 1u);
  EXPECT_EQ(refused.final_table.size(), 0);
}

TEST_F(ReplayTest, DataWithoutWhatLearningNeedsAreRefusedWithTheReason) {
  EXPECT_NE(Refusal("t_s,gyro_x_dps,gyro_y_dps,gyro_z_dps,imu_degc\n0,1,1,1,20\n")
                .find("accel_x_g (stillness)"),
            std::string::npos);
  EXPECT_NE(Refusal("t_s,gyro_x_dps,gyro_y_dps,accel_x_g,accel_y_g,accel_z_g\n0,1,1,0,0,1\n")
                .find("gyro_z_dps (raw gyro samples); imu_degc"),
            std::string::npos);
  EXPECT_NE(Refusal("gyro_x_dps,gyro_y_dps,gyro_z_dps,imu_degc,accel_x_g,accel_y_g,accel_z_g\n")
                .find("t_s (or a sample rate in the map)"),
            std::string::npos);
  std::string slow =
      "t_s,gyro_x_dps,gyro_y_dps,gyro_z_dps,imu_degc,accel_x_g,accel_y_g,accel_z_g\n";
  EXPECT_NE(Refusal(slow).find("sample rate cannot be told"), std::string::npos);
  for (int i = 0; i < 9; ++i) slow += std::to_string(i) + ",1,1,1,20,0,0,1\n";
  EXPECT_NE(Refusal(slow).find("no raw samples"), std::string::npos);
  EXPECT_NE(Replay(Path("absent.csv"), {}).error().message.find("absent.csv"), std::string::npos);
}

/// Real recordings are too large for the repository: ZROBENCH_RECORDINGS names their folder.
class RealRecordings : public ReplayTest {
 protected:
  void SetUp() override {
    ReplayTest::SetUp();
    const char* const recordings = std::getenv("ZROBENCH_RECORDINGS");
    if (recordings == nullptr) {
      GTEST_SKIP() << "ZROBENCH_RECORDINGS names no folder of recordings: NOT TESTED on real data";
    }
    recordings_ = recordings;
  }
  Result<ReplaySummary> Replayed(const std::string& file, const std::string& map) const {
    ReplayOptions options;
    options.map = ZROBENCH_SOURCE_DIR "/profiles/imports/" + map;
    return Replay(recordings_ / file, options);
  }
  std::filesystem::path recordings_;
};

TEST_F(RealRecordings, FreeImuColdStartIsLearnedFarBetterThanOneConstant) {
  const auto summary =
      Replayed("gyro_freeimu_mpu6050_coldstart/Tempdata01-02-14.csv", "freeimu_mpu6050.toml");
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  EXPECT_EQ(summary->samples, 63792u);
  EXPECT_EQ(summary->gaps, 378u);
  EXPECT_GE(summary->errors.readings(), 10u);
  EXPECT_LT(summary->errors.corrector_rms_mdps(1), 0.25 * summary->errors.constant_rms_mdps(1));
  EXPECT_LT(summary->errors.corrector_rms_mdps(0), summary->errors.constant_rms_mdps(0));
}

TEST_F(RealRecordings, TenMinutesAtOneTemperatureMakeOneEntry) {
  const auto summary =
      Replayed("gyro_mpu6050_static_10min/mpu6050_static_10min.csv", "mpu6050_static.toml");
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  EXPECT_EQ(summary->samples, 65067u);
  ASSERT_EQ(summary->final_table.size(), 1);
  EXPECT_NEAR(summary->final_table[0].zro_dps[0], 4.53, 0.02);  // their own 30 s means
  EXPECT_NEAR(summary->final_table[0].zro_dps[1], 0.05, 0.02);
}

TEST_F(RealRecordings, MeansAfterTurnsAndLogsWithoutTimeAreRefusedWithTheReason) {
  const auto dwells =
      Replayed("gyro_adxrs290_earthrate/T16-4_mereni_data.csv", "adxrs290_dwells.toml");
  ASSERT_FALSE(dwells.has_value());
  EXPECT_NE(dwells.error().message.find("stillness"), std::string::npos);
  const auto putty = Replayed("gyro_bmi270_hot_cold/BMI_270_cold_test_.csv", "bmi270_putty.toml");
  ASSERT_FALSE(putty.has_value());
  EXPECT_NE(putty.error().message.find("t_s (or a sample rate"), std::string::npos);
}

}  // namespace
}  // namespace zrobench::testing
