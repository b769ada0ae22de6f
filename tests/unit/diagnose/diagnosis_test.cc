// The whole diagnosis on recordings of the rig's own model: what was hidden is named, and nothing
// is named where nothing was.
#include "rig/diagnose/diagnosis.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "rig/diagnose/diagnosis_json.h"
#include "rig/diagnose/diagnosis_text.h"
#include "tests/unit/diagnose/bench_recording.h"

namespace zrobench::diagnose {
namespace {

using testing::HasSubstr;

Diagnosis Of(const Case& loaded) {
  return Diagnose(loaded, [](std::string_view) {});
}

/// The bench's true values lie beside the station's.
physics::Model Scattered() {
  physics::Model actual;
  actual.plate.heater_w *= 1.15;
  actual.board->to_plate_w_per_k *= 0.85;
  actual.package->time_constant_s *= 1.2;
  actual.ambient_degc += 0.4;
  for (auto& axis : actual.gyro->zro_dps) axis[1] *= 1.1;
  return actual;
}

const ParameterFound& ParameterOf(const TermFound& term, std::string_view name) {
  for (const ParameterFound& p : term.parameters) {
    if (p.name == name) return p;
  }
  throw std::runtime_error("no such parameter: " + std::string(name));
}

TEST(Diagnosis, NothingIsNamedWhereOnlyNominalValuesDiffer) {
  for (const std::uint64_t seed : {1, 11, 21}) {
    const Diagnosis d =
        Of(BenchRecording{.nominal = {}, .actual = Scattered(), .seed = seed}.Make());
    EXPECT_EQ(OutcomeName(d.outcome), "no_missing_physics") << "seed " << seed;
    EXPECT_TRUE(d.terms.empty());
    EXPECT_FALSE(d.limits.empty());
    EXPECT_LT(d.errors.before.at("gyro_x_dps"), 0.004);
  }
}

TEST(Diagnosis, AHiddenTemperatureRateIsNamedWithItsSize) {
  BenchRecording recording{.nominal = {}, .actual = Scattered()};
  recording.actual.terms = {"gyro.temperature_rate"};
  recording.actual.term["gyro.temperature_rate"]["dps_per_k_per_s"] = {0.05, -0.03, 0.0};
  const Diagnosis d = Of(recording.Make());
  ASSERT_EQ(OutcomeName(d.outcome), "named");
  ASSERT_EQ(d.terms.size(), 1u);
  EXPECT_EQ(d.terms[0].info->id, "gyro.temperature_rate");
  const ParameterFound& x = ParameterOf(d.terms[0], "dps_per_k_per_s_x");
  EXPECT_NEAR(x.value, 0.05, 0.006);
  ASSERT_TRUE(x.ci95);
  EXPECT_GT(x.ci95->first, 0.03);
  EXPECT_LT(d.errors.heldout_after.at("gyro_x_dps"), d.errors.heldout_before.at("gyro_x_dps"));
}

TEST(Diagnosis, AHiddenSupplySensitivityIsNamed) {
  BenchRecording recording{.nominal = {}, .actual = Scattered()};
  recording.actual.terms = {"gyro.supply"};
  recording.actual.term["gyro.supply"]["dps_per_v"] = {0.0, 0.08, 0.05};
  const Diagnosis d = Of(recording.Make());
  ASSERT_EQ(OutcomeName(d.outcome), "named");
  EXPECT_EQ(d.terms[0].info->id, "gyro.supply");
  EXPECT_NEAR(ParameterOf(d.terms[0], "dps_per_v_y").value, 0.08, 0.01);
  EXPECT_THAT(ToText(d, "case"), HasSubstr("gyro.supply"));
}

TEST(Diagnosis, AHiddenDeadTimeIsNamedOrStandsInTheSet) {
  BenchRecording recording{.nominal = {}, .actual = Scattered()};
  recording.actual.terms = {"thermal.dead_time"};
  recording.actual.term["thermal.dead_time"] = {{"dead_time_s", {2}}};
  const Diagnosis d = Of(recording.Make());
  EXPECT_TRUE(d.mismatch.detected);
  bool reached = false;
  for (const TermFound& term : d.terms) reached |= term.info->id == "thermal.dead_time";
  for (const physics::TermInfo* info : d.ambiguity) reached |= info->id == "thermal.dead_time";
  EXPECT_TRUE(reached) << ToText(d, "case");
}

TEST(Diagnosis, AValueFarFromNominalIsCalledThat) {
  BenchRecording recording;
  recording.actual.plate.to_ambient_w_per_k *= 4;
  const Diagnosis d = Of(recording.Make());
  ASSERT_EQ(OutcomeName(d.outcome), "recalibrate") << ToText(d, "case");
  EXPECT_EQ(d.recalibrations.at(0).key, "model.plate.to_ambient_w_per_k");
  EXPECT_NEAR(d.recalibrations.at(0).fitted, 1.2, 0.05);
}

TEST(Diagnosis, BrokenDataGetNoPhysicalName) {
  Case stuck = BenchRecording{}.Make();
  for (Row& row : stuck.runs[1].rows) row[Channel::kImuTemperature] = 23.5;
  Diagnosis d = Of(stuck);
  EXPECT_EQ(OutcomeName(d.outcome), "bus_fault");
  EXPECT_THAT(d.reason, HasSubstr("run-2: imu_degc"));
  Case wrong_unit = BenchRecording{}.Make();
  for (Row& row : wrong_unit.runs[0].rows) row[Channel::kPlate] *= 1000;
  EXPECT_EQ(OutcomeName(Of(wrong_unit).outcome), "bus_fault");
  Case brief = BenchRecording{}.Make();
  for (CaseRun& run : brief.runs) run.rows.resize(20);
  EXPECT_EQ(OutcomeName(Of(brief).outcome), "bus_fault");
}

TEST(Diagnosis, GapsAreNoPhysics) {
  Case gaps = BenchRecording{.nominal = {}, .actual = Scattered()}.Make();
  for (std::size_t i = 1000; i < 1400; ++i) {
    gaps.runs[0].rows[i][Channel::kImuTemperature] = std::numeric_limits<double>::quiet_NaN();
    gaps.runs[1].rows[i][Channel::kGyroY] = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_EQ(OutcomeName(Of(gaps).outcome), "no_missing_physics");
}

TEST(Diagnosis, WhatTheStationKnowsIsNoMismatch) {
  BenchRecording recording{.nominal = {}, .actual = Scattered()};
  recording.nominal.terms = recording.actual.terms = {"gyro.supply"};
  recording.actual.term["gyro.supply"]["dps_per_v"] = {0.08, 0.08, 0.08};
  EXPECT_EQ(OutcomeName(Of(recording.Make()).outcome), "no_missing_physics");
  recording.actual.terms.emplace_back("gyro.temperature_rate");
  recording.actual.term["gyro.temperature_rate"]["dps_per_k_per_s"] = {0.05, 0.05, 0.05};
  const Diagnosis d = Of(recording.Make());
  ASSERT_EQ(OutcomeName(d.outcome), "named");
  ASSERT_EQ(d.terms.size(), 1u);
  EXPECT_EQ(d.terms[0].info->id, "gyro.temperature_rate");
  EXPECT_NEAR(ParameterOf(d.terms[0], "dps_per_k_per_s_x").value, 0.05, 0.006);
  // The first run rests at 55 degC there, while the supply steps.
  const std::map<std::string, std::vector<std::pair<double, double>>>& where =
      d.mismatch.intervals_s;
  ASSERT_TRUE(where.contains("run-1"));
  for (const auto& [begin, end] : where.at("run-1")) {
    EXPECT_FALSE(begin < 1100 && end > 900) << begin << ".." << end;
  }
}

TEST(Diagnosis, LimitsBelongToTheirParameter) {
  // The board is turned upside down for a while: only gravity along z changes.
  Case turned = BenchRecording{}.Make();
  for (CaseRun& run : turned.runs) {
    for (const Channel c : {Channel::kAccelX, Channel::kAccelY, Channel::kAccelZ}) {
      run.present[Index(c)] = true;
    }
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
      run.rows[i][Channel::kAccelX] = run.rows[i][Channel::kAccelY] = 0;
      run.rows[i][Channel::kAccelZ] = i / 400 % 2 == 0 ? 1 : -1;
    }
  }
  const Diagnosis d = Of(turned);
  const auto limit = std::ranges::find_if(
      d.limits, [](const Limit& l) { return l.info->id == "gyro.g_sensitivity"; });
  ASSERT_NE(limit, d.limits.end());
  EXPECT_EQ(limit->parameter, "dps_per_g_from_z");
}

TEST(Diagnosis, WithoutAKnownPowerOnNoWarmUpIsTested) {
  Case loaded = BenchRecording{}.Make();
  EXPECT_THAT(Of(loaded).not_testable, testing::Not(testing::Contains("gyro.warm_up")));
  loaded.station.recording.starts_at_power_on = false;
  EXPECT_THAT(Of(loaded).not_testable, testing::Contains("gyro.warm_up"));
}

TEST(Diagnosis, WhatTheColumnsCannotShowIsSaid) {
  const Diagnosis d = Of(BenchRecording{}.Make());
  EXPECT_THAT(d.not_testable, testing::Contains("acoustic.rectification"));
  EXPECT_THAT(d.not_testable, testing::Contains("gyro.g_sensitivity"));
}

TEST(Diagnosis, IsDeterministicAndItsJsonHasEveryField) {
  const Case loaded = BenchRecording{}.Make();
  const auto first = ToJson(Of(loaded));
  EXPECT_EQ(first.dump(), ToJson(Of(loaded)).dump());
  for (const char* key :
       {"schema", "verdict", "mismatch", "terms", "ambiguity", "free_form", "detection_limits",
        "not_excited", "not_testable", "heldout", "next_profile", "seconds"}) {
    EXPECT_TRUE(first.contains(key)) << key;
  }
}

}  // namespace
}  // namespace zrobench::diagnose
