#include "rig/diagnose/diagnosis_json.h"

#include <nlohmann/json.hpp>

namespace zrobench::diagnose {
namespace {

using Json = nlohmann::ordered_json;

Json Object(const PerChannel& values) {
  Json object = Json::object();
  for (const auto& [channel, value] : values) object[channel] = value;
  return object;
}

Json Ids(const std::vector<const physics::TermInfo*>& infos) {
  Json ids = Json::array();
  for (const physics::TermInfo* info : infos) ids.push_back(std::string(info->id));
  return ids;
}

Json Parameters(const TermFound& term) {
  Json parameters = Json::object();
  for (const ParameterFound& p : term.parameters) {
    Json& entry = parameters[p.name];
    entry = {{"value", p.value}, {"unit", p.unit}};
    entry["ci95"] = p.ci95 ? Json{p.ci95->first, p.ci95->second} : Json(nullptr);
  }
  return parameters;
}

Json Term(const TermFound& term, const Errors& errors) {
  return {{"id", std::string(term.info->id)},
          {"sentence", std::string(term.info->sentence)},
          {"equation", std::string(term.info->equation)},
          {"parameters", Parameters(term)},
          {"channels", term.info->channels},
          {"log_likelihood_gain", term.log_likelihood_gain},
          {"p_value", term.p_value},
          {"rmse_before", Object(errors.before)},
          {"rmse_after", Object(errors.after)},
          {"heldout_rmse_before", Object(errors.heldout_before)},
          {"heldout_rmse_after", Object(errors.heldout_after)},
          {"noise_floor_rmse", Object(errors.noise_floor)}};
}

Json MismatchObject(const Mismatch& mismatch) {
  Json intervals = Json::object();
  for (const auto& [run, stretches] : mismatch.intervals_s) {
    Json& list = intervals[run] = Json::array();
    for (const auto& [begin, end] : stretches) list.push_back({begin, end});
  }
  return {{"detected", mismatch.detected},
          {"channels", mismatch.channels},
          {"intervals_s", intervals},
          {"conditions", Json::array()},
          {"share_of_energy", mismatch.share_of_energy}};
}

}  // namespace

Json ToJson(const Diagnosis& d) {
  Json json = {{"schema", 1}, {"verdict", std::string(OutcomeName(d.outcome))}};
  if (!d.reason.empty()) json["reason"] = d.reason;
  json["mismatch"] = MismatchObject(d.mismatch);
  json["terms"] = Json::array();
  for (const TermFound& term : d.terms) json["terms"].push_back(Term(term, d.errors));
  json["ambiguity"] = Ids(d.ambiguity);
  json["free_form"] = nullptr;
  json["detection_limits"] = Json::array();
  for (const Limit& limit : d.limits) {
    json["detection_limits"].push_back({{"id", std::string(limit.info->id)},
                                        {"parameter", limit.parameter},
                                        {"smallest_visible", limit.smallest_visible},
                                        {"unit", limit.unit}});
  }
  json["not_excited"] = d.not_excited;
  json["not_testable"] = d.not_testable;
  json["heldout"] = {{"runs", d.heldout_runs},
                     {"how", d.heldout_runs.empty() ? "none: a single run"
                                                    : "each run predicted by fits to the others"}};
  json["recalibrate"] = Json::array();
  for (const Recalibration& r : d.recalibrations) {
    json["recalibrate"].push_back(
        {{"key", r.key}, {"nominal", r.nominal}, {"fitted", r.fitted}, {"sd", r.sd}});
  }
  json["next_profile"] = nullptr;
  json["evidence"] = {
      {"best", d.evidence}, {"threshold", d.threshold}, {"leftover_log_p", d.leftover_log_p}};
  for (const Seen& seen : d.scan) {
    json["evidence"]["terms"][std::string(seen.info->id)] = seen.evidence;
  }
  json["noise"] = d.noise;
  json["seconds"] = d.seconds;
  return json;
}

}  // namespace zrobench::diagnose
