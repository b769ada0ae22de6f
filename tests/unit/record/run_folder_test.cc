#include "rig/record/run_folder.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "rig/record/utc_text.h"
#include "tests/unit/record/record_fixture.h"

namespace zrobench::testing {
namespace {

using nlohmann::json;

constexpr UtcNs kEpoch = 1'767'225'600'000'000'000;  // 2026-01-01T00:00:00Z
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RunManifest Finished() {
  RunManifest m;
  m.profile = "smoke";
  m.station = "bench-03";
  m.version = "0.1.0";
  m.seed = 18'446'744'073'709'551'615u;
  m.started = kEpoch;
  m.ended = kEpoch + 90'000'001'000;
  m.verdict = Verdict::kFail;
  m.exit_code = 1;
  m.operator_name = "Eva";
  m.real_s = 2.5;
  Measurement accuracy{"table_accuracy.25.x", 3.5, "mdps", -kInfinity, 6.0, 0.25, 100, 200};
  Measurement unknown{"x", std::nan(""), "1", 0, kInfinity, kInfinity, 0, 0};
  m.checks = {{"table_accuracy", "is it near the truth?", Verdict::kPass, "", {accuracy}},
              {"b", "", Verdict::kMarginal, "near", {}},
              {"c", "", Verdict::kFail, "too far", {unknown}},
              {"d", "", Verdict::kInconclusive, "no data", {}},
              {"e", "", Verdict::kRigError, "plate silent", {}}};
  return m;
}

/// The part of JSON Schema 2020-12 that our schema uses. Gives the path of the first offence.
class SchemaCheck {
 public:
  explicit SchemaCheck(json root) : root_(std::move(root)) {}
  std::string Offence(const json& value) const { return Check(root_, value, "$"); }

 private:
  static bool IsType(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "null") return value.is_null();
    ADD_FAILURE() << "unknown type " << type;
    return false;
  }
  std::string Check(const json& schema, const json& value, const std::string& at) const {
    if (schema.contains("$ref")) {
      return Check(root_.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1))), value,
                   at);
    }
    if (schema.contains("oneOf")) {
      int fitting = 0;
      for (const json& one : schema["oneOf"]) fitting += Check(one, value, at).empty();
      if (fitting != 1) return at + ": oneOf";
    }
    if (schema.contains("const") && value != schema["const"]) return at + ": const";
    if (schema.contains("enum")) {
      const auto& values = schema["enum"];
      if (std::find(values.begin(), values.end(), value) == values.end()) return at + ": enum";
    }
    if (schema.contains("type") && !FitsType(schema["type"], value)) return at + ": type";
    if (schema.contains("minimum") && value < schema["minimum"]) return at + ": minimum";
    if (value.is_object()) return CheckObject(schema, value, at);
    if (value.is_array()) return CheckArray(schema, value, at);
    return {};
  }
  static bool FitsType(const json& types, const json& value) {
    if (types.is_string()) return IsType(value, types);
    return std::any_of(types.begin(), types.end(),
                       [&](const json& type) { return IsType(value, type); });
  }
  std::string CheckObject(const json& schema, const json& value, const std::string& at) const {
    const json required = schema.value("required", json::array());
    for (const json& key : required) {
      if (!value.contains(key.get<std::string>())) return at + "." + key.get<std::string>();
    }
    const json properties = schema.value("properties", json::object());
    for (const auto& [key, part] : properties.items()) {
      if (!value.contains(key)) continue;
      if (auto offence = Check(part, value[key], at + "." + key); !offence.empty()) return offence;
    }
    return {};
  }
  std::string CheckArray(const json& schema, const json& value, const std::string& at) const {
    if (value.size() < schema.value("minItems", 0u)) return at + ": minItems";
    if (value.size() > schema.value("maxItems", 1000u)) return at + ": maxItems";
    for (const json& element : value) {
      if (!schema.contains("items")) break;
      if (auto offence = Check(schema["items"], element, at + "[]"); !offence.empty()) {
        return offence;
      }
    }
    return {};
  }
  json root_;
};

class RunFolderTest : public FolderTest {
 protected:
  static SchemaCheck Schema() {
    return SchemaCheck(json::parse(Read(ZROBENCH_SOURCE_DIR "/docs/run-json.schema.json")));
  }
};

TEST_F(RunFolderTest, ManifestComesBackAsItWentIn) {
  const RunManifest m = Finished();
  const auto back = ManifestFromJson(ToJson(m));
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(ToJson(*back), ToJson(m));
  EXPECT_EQ(back->seed, m.seed);
  EXPECT_EQ(back->ended, m.ended);
  EXPECT_EQ(back->verdict, Verdict::kFail);
  EXPECT_EQ(back->operator_name, "Eva");
  ASSERT_EQ(back->checks.size(), 5u);
  const Measurement& accuracy = back->checks[0].measurements.at(0);
  EXPECT_EQ(accuracy.low, -kInfinity);
  EXPECT_EQ(accuracy.high, 6.0);
  EXPECT_EQ(accuracy.last_us, 200u);
  EXPECT_TRUE(std::isnan(back->checks[2].measurements.at(0).value));
}

TEST_F(RunFolderTest, MarginalCountsAsPassedAndWhatWasNotJudgedAsSkipped) {
  const CheckCounts counts = CountChecks(Finished().checks);
  EXPECT_EQ(counts.passed, 2);
  EXPECT_EQ(counts.failed, 1);
  EXPECT_EQ(counts.skipped, 2);
  EXPECT_EQ(json::parse(ToJson(Finished()))["counts"]["passed"], 2);
}

TEST_F(RunFolderTest, WhatIsWrittenFitsTheSchema) {
  EXPECT_EQ(Schema().Offence(json::parse(ToJson(Finished()))), "");
  RunManifest running;
  running.backend = "hardware";
  EXPECT_EQ(Schema().Offence(json::parse(ToJson(running))), "");
}

TEST_F(RunFolderTest, TheSchemaRefusesWhatDoesNotFit) {
  const json good = json::parse(ToJson(Finished()));
  const auto offence = [&](const char* pointer, const json& value) {
    json bad = good;
    bad[json::json_pointer(pointer)] = value;
    return Schema().Offence(bad);
  };
  EXPECT_EQ(offence("/verdict", "splendid"), "$.verdict: oneOf");
  EXPECT_EQ(offence("/schema", 2), "$.schema: const");
  EXPECT_EQ(offence("/checks/0/measurements/0/value", "3"),
            "$.checks[].measurements[].value: type");
  EXPECT_EQ(offence("/counts/failed", -1), "$.counts.failed: minimum");
  json without = good;
  without.erase("exit_code");
  EXPECT_EQ(Schema().Offence(without), "$.exit_code");
}

TEST_F(RunFolderTest, DamagedManifestsAreRefusedWithTheReason) {
  for (const auto& [from, to] : {std::pair{"\"fail\"", "\"awful\""},
                                 {"\"seed\"", "\"sead\""},
                                 {"\"schema\": 1", "\"schema\": 7"},
                                 {"2026-01-01", "2026-13-01"}}) {
    std::string text = ToJson(Finished());
    text.replace(text.find(from), std::string(from).size(), to);
    const auto back = ManifestFromJson(text);
    ASSERT_FALSE(back.has_value()) << to;
    EXPECT_EQ(back.error().kind, Error::Kind::kFile);
    EXPECT_EQ(back.error().message.rfind("run.json", 0), 0u) << back.error().message;
  }
}

TEST_F(RunFolderTest, FoldersAreNamedByTimeStationAndProfileAndNeverShared) {
  const auto first = RunFolder::Create(Path("runs"), kEpoch, "bench 03", "a/b");
  const auto second = RunFolder::Create(Path("runs"), kEpoch, "bench 03", "a/b");
  ASSERT_TRUE(first.has_value() && second.has_value());
  EXPECT_EQ(first->path().filename(), "2026-01-01T000000Z-bench-03-a-b");
  EXPECT_EQ(second->path().filename(), "2026-01-01T000000Z-bench-03-a-b-2");
  EXPECT_TRUE(std::filesystem::is_directory(second->path()));
}

TEST_F(RunFolderTest, InputsAndManifestAreKept) {
  const auto folder = RunFolder::Create(Path("runs"), kEpoch, "s", "p");
  ASSERT_TRUE(folder.has_value());
  ASSERT_TRUE(folder->WriteInputs("profile = 1\n", "station = 2\n").has_value());
  ASSERT_TRUE(folder->WriteManifest(RunManifest{}).has_value());
  ASSERT_TRUE(folder->WriteManifest(Finished()).has_value());
  EXPECT_EQ(Read(folder->profile_path()), "profile = 1\n");
  EXPECT_EQ(Read(folder->station_path()), "station = 2\n");
  const auto manifest = folder->ReadManifest();
  ASSERT_TRUE(manifest.has_value());
  EXPECT_EQ(manifest->profile, "smoke");
  EXPECT_FALSE(std::filesystem::exists(folder->run_json_path().string() + ".tmp"));
}

TEST_F(RunFolderTest, OnlyAFolderWithARecordOpens) {
  const auto folder = RunFolder::Create(Path("runs"), kEpoch, "s", "p");
  EXPECT_FALSE(RunFolder::Open(folder->path()).has_value());
  Record(folder->record_path(), OneOfEach());
  EXPECT_TRUE(RunFolder::Open(folder->path()).has_value());
}

TEST_F(RunFolderTest, AFailedReplaceLeavesTheOldFile) {
  Write("file", "old");
  std::filesystem::create_directory(Path("file.tmp"));
  const Status status = WriteFileAtomically(Path("file"), "new");
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().kind, Error::Kind::kFile);
  EXPECT_EQ(Read(Path("file")), "old");
}

TEST(UtcTextTest, WritesAndReadsIso8601) {
  EXPECT_EQ(UtcText(kEpoch + 12'345'678'000), "2026-01-01T00:00:12.345678Z");
  EXPECT_EQ(ParseUtc("2026-01-01T00:00:12.345678Z"), kEpoch + 12'345'678'000);
  EXPECT_EQ(ParseUtc("2026-01-01"), kEpoch);
  EXPECT_EQ(ParseUtc("1970-01-01T00:00:01Z"), 1'000'000'000);
  for (const char* text : {"", "2026", "2026-02-30", "2026-01-01T25:00:00Z", "2026-01-01Tx",
                           "2026-01-01T00:00:00+01:00", "2026-01-01 "}) {
    EXPECT_FALSE(ParseUtc(text).has_value()) << text;
  }
}

TEST(UtcTextTest, CountsCanopenDays) {
  EXPECT_EQ(CanopenDays(0), 0);
  EXPECT_EQ(CanopenDays(*ParseUtc("1984-01-02")), 1);
  EXPECT_EQ(CanopenDays(*ParseUtc("2026-01-01T23:59:59Z")), 15341);
  EXPECT_EQ(CanopenDateText(15341), "2026-01-01");
}

}  // namespace
}  // namespace zrobench::testing
