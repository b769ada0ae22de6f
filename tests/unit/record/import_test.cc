#include <cmath>

#include "rig/record/replay/csv_source.h"
#include "rig/record/replay/import_map.h"
#include "tests/unit/record/record_fixture.h"

namespace zrobench::testing {
namespace {

class ImportTest : public FolderTest {
 protected:
  /// All rows, or the error's message.
  struct Outcome {
    std::vector<Row> rows;
    std::string error;
    std::size_t skipped = 0;
  };
  Outcome ReadCsv(const std::string& csv, const std::string& map_toml = {}) const {
    ImportMap map;
    if (!map_toml.empty()) {
      auto loaded = LoadImportMap(Write("map.toml", "schema = 1\n" + map_toml));
      if (!loaded) return {{}, loaded.error().message};
      map = *loaded;
    }
    auto source = CsvSource::Open(Write("in.csv", csv), map);
    if (!source) return {{}, source.error().message};
    Outcome outcome;
    for (;;) {
      const auto row = source->Next();
      if (!row) {
        EXPECT_EQ(row.error().kind, Error::Kind::kConfig);
        outcome.error = row.error().message;
        return outcome;
      }
      if (!*row) break;
      outcome.rows.push_back(**row);
    }
    outcome.skipped = source->skipped_rows();
    return outcome;
  }
  std::string Place(const std::string& name, int line) const {
    return Path(name).string() + ":" + std::to_string(line) + ": error: ";
  }
};

TEST_F(ImportTest, CanonicalColumnsNeedNoMap) {
  const auto got = ReadCsv("other,t_s, gyro_x_dps,imu_degc\r\nabc,0.5,-1e-1,\r\n,1.5,+2,25\r\n");
  ASSERT_EQ(got.rows.size(), 2u) << got.error;
  EXPECT_EQ(got.rows[0][Channel::kTime], 0.5);
  EXPECT_EQ(got.rows[0][Channel::kGyroX], -0.1);
  EXPECT_TRUE(std::isnan(got.rows[0][Channel::kImuTemperature]));
  EXPECT_TRUE(std::isnan(got.rows[0][Channel::kGyroY]));
  EXPECT_EQ(got.rows[1][Channel::kGyroX], 2);
  EXPECT_EQ(got.rows[1][Channel::kImuTemperature], 25);
}

TEST_F(ImportTest, ScaleOffsetAndUnitInThatOrder) {
  const auto got = ReadCsv("ms,T,w,a\n1500,-8884,3.14159265358979,9.80665\n", R"(
[channel]
t_s = { column = "ms", unit = "ms" }
imu_degc = { column = "T", scale = 0.0029411764705882353, offset = 309.68, unit = "K" }
gyro_z_dps = { column = "w", unit = "rad/s" }
accel_x_g = { column = "a", unit = "m/s2" })");
  ASSERT_EQ(got.rows.size(), 1u) << got.error;
  EXPECT_DOUBLE_EQ(got.rows[0][Channel::kTime], 1.5);
  EXPECT_NEAR(got.rows[0][Channel::kImuTemperature], -8884 / 340.0 + 36.53, 1e-9);
  EXPECT_NEAR(got.rows[0][Channel::kGyroZ], 180, 1e-9);
  EXPECT_DOUBLE_EQ(got.rows[0][Channel::kAccelX], 1);
}

TEST_F(ImportTest, DelimiterDecimalSignSkippedLinesAndComments) {
  const auto got = ReadCsv("banner line\n# made by x\nt;w\n0,5;1,25\n\n# note\n1,0;-2,5\n", R"(
[csv]
delimiter = ";"
decimal = ","
skip_lines = 1
comment = "#"
[channel]
t_s = { column = "t" }
gyro_x_dps = { column = "w" })");
  ASSERT_EQ(got.rows.size(), 2u) << got.error;
  EXPECT_EQ(got.rows[0][Channel::kTime], 0.5);
  EXPECT_EQ(got.rows[1][Channel::kGyroX], -2.5);
}

TEST_F(ImportTest, NoHeaderIndicesAndAStatedRate) {
  const auto got = ReadCsv("7  8 9\n 1 2\t3\n", R"(
[csv]
delimiter = " "
header = false
sample_hz = 50
[channel]
gyro_x_dps = { column = 2 })");
  ASSERT_EQ(got.rows.size(), 2u) << got.error;
  EXPECT_EQ(got.rows[0][Channel::kGyroX], 9);
  EXPECT_EQ(got.rows[0][Channel::kTime], 0);
  EXPECT_EQ(got.rows[1][Channel::kGyroX], 3);
  EXPECT_DOUBLE_EQ(got.rows[1][Channel::kTime], 0.02);
}

TEST_F(ImportTest, RowsAreFilteredByTextAndRange) {
  const auto got = ReadCsv("kind,t,w\nGPS,0,x\nIMU,1,5\nIMU,2,500\nIMU,3,-6\n", R"(
[[keep]]
column = "kind"
equals = "IMU"
[[keep]]
column = "w"
at_least = -10
at_most = 10
[channel]
t_s = { column = "t" }
gyro_x_dps = { column = "w" })");
  ASSERT_EQ(got.rows.size(), 2u) << got.error;
  EXPECT_EQ(got.rows[0][Channel::kTime], 1);
  EXPECT_EQ(got.rows[1][Channel::kTime], 3);
}

TEST_F(ImportTest, TornRowsAreSkippedWhereTheMapAllowsIt) {
  const std::string csv = "t,w\n0,1\n1\n2,x1\n3,4\n";
  const std::string channels =
      "[channel]\nt_s = { column = \"t\" }\ngyro_x_dps = { column = \"w\" }";
  const auto got = ReadCsv(csv, "[csv]\nbad_rows = \"skip\"\n" + channels);
  EXPECT_EQ(got.rows.size(), 2u) << got.error;
  EXPECT_EQ(got.skipped, 2u);
  EXPECT_EQ(ReadCsv(csv, channels).error,
            Place("in.csv", 3) + "the row has 1 fields, column 2 is wanted");
}

TEST_F(ImportTest, ALastLineThatWasCutIsLeftOut) {
  const auto got = ReadCsv("t_s,gyro_x_dps\n0,1\n1,2\n2");
  EXPECT_EQ(got.rows.size(), 2u) << got.error;
  EXPECT_EQ(ReadCsv("t_s,gyro_x_dps\n0,1\n1,2").rows.size(), 2u);
}

TEST_F(ImportTest, BrokenRowsAreNamedByFileAndLine) {
  EXPECT_EQ(ReadCsv("t_s,gyro_x_dps\n0,1\n1,nan\n2,2\n").error,
            Place("in.csv", 3) + "column 2: 'nan' is no finite number");
  EXPECT_EQ(ReadCsv("t_s,gyro_x_dps\n0,1e999\n").error,
            Place("in.csv", 2) + "column 2: '1e999' is no finite number");
  EXPECT_EQ(ReadCsv("t_s,gyro_x_dps\n0,1\n\n0.5,twelve\n").error,
            Place("in.csv", 4) + "column 2: 'twelve' is no finite number");
  EXPECT_EQ(ReadCsv("t_s,gyro_x_dps\n1,1\n0.5,1\n").error,
            Place("in.csv", 3) + "time goes backwards: 0.5 s after 1 s");
  EXPECT_EQ(ReadCsv("t_s,gyro_x_dps\n,1\n").error, Place("in.csv", 2) + "a row without a time");
}

TEST_F(ImportTest, WrongDelimiterMissingColumnAndEmptyFileAreSaid) {
  const std::string channels = "[channel]\nt_s = { column = \"t\" }";
  const auto wrong = ReadCsv("t;w\n0;1\n", channels).error;
  EXPECT_EQ(wrong.rfind(Place("in.csv", 1) + "no column 't' among 1 (delimiter ',')", 0), 0u)
      << wrong;
  const auto foreign = ReadCsv("a,b\n1,2\n").error;
  EXPECT_EQ(foreign.rfind(Place("in.csv", 1) + "no canonical column", 0), 0u) << foreign;
  EXPECT_NE(ReadCsv("").error.find("empty"), std::string::npos);
  EXPECT_NE(ReadCsv("t_s,t_s\n").error.find("column t_s twice"), std::string::npos);
}

TEST_F(ImportTest, AMapsErrorsAreAllSaidAtOnceWithTheirPlaces) {
  const auto error = ReadCsv("t\n", R"(
[csv]
delimiter = "--"
colour = 1
[[keep]]
column = "x"
[channel]
t_s = { column = "t", unit = "furlong" }
gyro_q_dps = { column = "g" }
gyro_x_dps = { scale = "two" })")
                         .error;
  for (const char* part :
       {"map.toml:4:13: error: delimiter must be one character",
        "map.toml:5:1: error: 'colour' is not a key of [csv]", "[[keep]] needs",
        "'furlong' is no unit of t_s; known: s, ms",
        "map.toml:10:1: error: 'gyro_q_dps' is not a key of [channel]; did you mean 'gyro_x_dps'?",
        "'column' is missing in gyro_x_dps", "scale must be a number, not a text"}) {
    EXPECT_NE(error.find(part), std::string::npos) << part << "\n" << error;
  }
}

TEST_F(ImportTest, QuotedFieldsKeepTheirDelimitersAndTheMarkInFrontIsNoName) {
  const auto got = ReadCsv("\xEF\xBB\xBFt_s,\"note, free\",gyro_x_dps\r\n0,\"a,\"\"b\",1.5\r\n");
  ASSERT_EQ(got.rows.size(), 1u) << got.error;
  EXPECT_EQ(got.rows[0][Channel::kGyroX], 1.5);
}

TEST_F(ImportTest, WhatCouldBeReadWronglyIsRefused) {
  const std::string comma =
      "[csv]\ndelimiter = \";\"\ndecimal = \",\"\n[channel]\n"
      "gyro_x_dps = { column = \"w\" }";
  EXPECT_NE(ReadCsv("w\n1.234\n", comma).error.find("'1.234' is no finite number"),
            std::string::npos);
  const std::string named = "[channel]\ngyro_x_dps = { column = \"w\" }";
  EXPECT_NE(ReadCsv("w,w\n1,2\n", named).error.find("'w' twice"), std::string::npos);
  const std::string huge = "[channel]\ngyro_x_dps = { column = \"w\", scale = 1e10 }";
  EXPECT_NE(ReadCsv("w\n1e300\n", huge).error.find("too large once scaled"), std::string::npos);
  EXPECT_NE(ReadCsv("t_s,gyro_x_dps\n1e12,1\n").error.find("is its unit right?"),
            std::string::npos);
  EXPECT_NE(ReadCsv("t_s,seq\n" + std::string(70000, '1')).error.find("this is no CSV"),
            std::string::npos);
}

TEST_F(ImportTest, BrokenTomlIsPlaced) {
  EXPECT_NE(ReadCsv("t\n", "[channel\n").error.find("map.toml:2:"), std::string::npos);
  EXPECT_NE(ReadCsv("t\n", "[csv]\nheader = false\n[channel]\nt_s = { column = \"t\" }")
                .error.find("needs a header"),
            std::string::npos);
}

}  // namespace
}  // namespace zrobench::testing
