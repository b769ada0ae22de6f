#include "rig/record/run_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "rig/record/utc_text.h"

namespace zrobench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::pair<Verdict, std::string_view> kVerdicts[] = {
    {Verdict::kPass, "pass"},
    {Verdict::kMarginal, "marginal"},
    {Verdict::kInconclusive, "inconclusive"},
    {Verdict::kFail, "fail"},
    {Verdict::kRigError, "rig_error"}};

Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double NumberOr(const Json& j, double otherwise) {
  return j.is_null() ? otherwise : j.get<double>();
}

Json MeasurementJson(const Measurement& m) {
  return {{"name", m.name},
          {"value", NumberOrNull(m.value)},
          {"unit", m.unit},
          {"low", NumberOrNull(m.low)},
          {"high", NumberOrNull(m.high)},
          {"uncertainty_k2", NumberOrNull(m.uncertainty_k2)},
          {"record_us", {m.first_us, m.last_us}}};
}

Measurement MeasurementFrom(const Json& j) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Measurement m;
  m.name = j.at("name").get<std::string>();
  m.value = NumberOr(j.at("value"), kNone);
  m.unit = j.at("unit").get<std::string>();
  m.low = NumberOr(j.at("low"), -kInfinity);
  m.high = NumberOr(j.at("high"), kInfinity);
  m.uncertainty_k2 = NumberOr(j.at("uncertainty_k2"), kInfinity);
  m.first_us = j.at("record_us").at(0).get<std::uint64_t>();
  m.last_us = j.at("record_us").at(1).get<std::uint64_t>();
  return m;
}

Json CheckJson(const CheckResult& check) {
  Json measurements = Json::array();
  for (const Measurement& m : check.measurements) measurements.push_back(MeasurementJson(m));
  return {{"check", check.check},
          {"about", check.about},
          {"verdict", VerdictName(check.verdict)},
          {"reason", check.reason},
          {"measurements", std::move(measurements)}};
}

Verdict VerdictFrom(const Json& j) {
  const auto verdict = VerdictNamed(j.get<std::string>());
  if (!verdict) throw std::invalid_argument("unknown verdict '" + j.get<std::string>() + "'");
  return *verdict;
}

CheckResult CheckFrom(const Json& j) {
  CheckResult check;
  check.check = j.at("check").get<std::string>();
  check.about = j.at("about").get<std::string>();
  check.verdict = VerdictFrom(j.at("verdict"));
  check.reason = j.at("reason").get<std::string>();
  for (const Json& m : j.at("measurements")) check.measurements.push_back(MeasurementFrom(m));
  return check;
}

UtcNs UtcFrom(const Json& j) {
  const auto utc = ParseUtc(j.get<std::string>());
  if (!utc) throw std::invalid_argument("no UTC time: '" + j.get<std::string>() + "'");
  return *utc;
}

template <typename T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void PutIfGiven(Json& j, const char* key, const std::string& value) {
  if (!value.empty()) j[key] = value;
}

RunManifest ManifestFrom(const Json& j) {
  RunManifest m;
  m.profile = j.at("profile").get<std::string>();
  m.station = j.at("station").get<std::string>();
  m.backend = j.at("backend").get<std::string>();
  m.version = j.at("version").get<std::string>();
  m.seed = j.at("seed").get<std::uint64_t>();
  m.started = UtcFrom(j.at("started"));
  if (!j.at("ended").is_null()) m.ended = UtcFrom(j.at("ended"));
  if (!j.at("verdict").is_null()) m.verdict = VerdictFrom(j.at("verdict"));
  if (!j.at("exit_code").is_null()) m.exit_code = j.at("exit_code").get<int>();
  m.reason = j.at("reason").get<std::string>();
  for (const Json& check : j.at("checks")) m.checks.push_back(CheckFrom(check));
  m.operator_name = j.value("operator", "");
  m.lot = j.value("lot", "");
  m.board_serial = j.value("board_serial", "");
  m.host = j.value("host", "");
  m.build = j.value("build", "");
  m.real_s = j.value("real_s", 0.0);
  return m;
}

}  // namespace

CheckCounts CountChecks(const std::vector<CheckResult>& checks) {
  CheckCounts counts;
  for (const CheckResult& check : checks) {
    switch (check.verdict) {
      case Verdict::kPass:
      case Verdict::kMarginal:
        ++counts.passed;
        break;
      case Verdict::kFail:
        ++counts.failed;
        break;
      case Verdict::kInconclusive:
      case Verdict::kRigError:
        ++counts.skipped;
        break;
    }
  }
  return counts;
}

std::string_view VerdictName(Verdict verdict) {
  for (const auto& [value, name] : kVerdicts) {
    if (value == verdict) return name;
  }
  return "unknown";
}

std::optional<Verdict> VerdictNamed(std::string_view name) {
  for (const auto& [value, known] : kVerdicts) {
    if (known == name) return value;
  }
  return std::nullopt;
}

std::string ToJson(const RunManifest& m) {
  const CheckCounts counts = CountChecks(m.checks);
  Json j = {{"schema", RunManifest::kSchema},
            {"profile", m.profile},
            {"station", m.station},
            {"backend", m.backend},
            {"version", m.version},
            {"seed", m.seed},
            {"started", UtcText(m.started)},
            {"ended", m.ended ? Json(UtcText(*m.ended)) : Json(nullptr)},
            {"verdict", m.verdict ? Json(VerdictName(*m.verdict)) : Json(nullptr)},
            {"exit_code", OrNull(m.exit_code)},
            {"reason", m.reason},
            {"counts",
             {{"passed", counts.passed}, {"failed", counts.failed}, {"skipped", counts.skipped}}},
            {"checks", Json::array()}};
  for (const CheckResult& check : m.checks) j["checks"].push_back(CheckJson(check));
  PutIfGiven(j, "operator", m.operator_name);
  PutIfGiven(j, "lot", m.lot);
  PutIfGiven(j, "board_serial", m.board_serial);
  PutIfGiven(j, "host", m.host);
  PutIfGiven(j, "build", m.build);
  j["real_s"] = m.real_s;
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<RunManifest> ManifestFromJson(const std::string& text) {
  try {
    const Json j = Json::parse(text);
    if (j.at("schema") != RunManifest::kSchema) {
      return Fail(Error::Kind::kFile, fmt::format("run.json has schema {}, this program reads {}",
                                                  j.at("schema").dump(), RunManifest::kSchema));
    }
    return ManifestFrom(j);
  } catch (const std::exception& error) {
    return Fail(Error::Kind::kFile, fmt::format("run.json: {}", error.what()));
  }
}

}  // namespace zrobench
