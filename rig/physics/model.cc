#include "rig/physics/model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/units.h"
#include "rig/physics/term.h"

namespace zrobench::physics {
namespace {

/// Collects what is wrong; every check names the key as the station file does.
class Findings {
 public:
  void Positive(const char* key, double value) {
    Require(std::isfinite(value) && value > 0, key, "> 0", value);
  }
  void NotNegative(const char* key, double value) {
    Require(std::isfinite(value) && value >= 0, key, ">= 0", value);
  }
  void Finite(const std::string& key, double value) {
    Require(std::isfinite(value), key, "finite", value);
  }
  void Require(bool holds, const std::string& key, const char* what, double value) {
    if (!holds) Add(key, fmt::format("must be {}, is {}", what, value));
  }
  void Add(std::string key, const std::string& complaint) {
    std::string message = key + " " + complaint;
    errors_.push_back({std::move(key), std::move(message)});
  }
  std::vector<ModelError> Take() { return std::move(errors_); }

 private:
  std::vector<ModelError> errors_;
};

void CheckHeat(const Model& model, Findings& f) {
  f.Require(std::isfinite(model.ambient_degc) && model.ambient_degc > -kKelvinOffset,
            "model.ambient.degc", "above absolute zero", model.ambient_degc);
  f.Positive("model.plate.heat_capacity_j_per_k", model.plate.heat_capacity_j_per_k);
  f.NotNegative("model.plate.heater_w", model.plate.heater_w);
  f.NotNegative("model.plate.cooler_w", model.plate.cooler_w);
  f.NotNegative("model.plate.to_ambient_w_per_k", model.plate.to_ambient_w_per_k);
  f.NotNegative("model.plate.resolution_degc", model.plate.resolution_degc);
  if (model.board) {
    f.Positive("model.board.heat_capacity_j_per_k", model.board->heat_capacity_j_per_k);
    f.NotNegative("model.board.to_plate_w_per_k", model.board->to_plate_w_per_k);
    f.NotNegative("model.board.to_ambient_w_per_k", model.board->to_ambient_w_per_k);
  }
  if (model.package) {
    f.Positive("model.package.time_constant_s", model.package->time_constant_s);
    f.NotNegative("model.package.resolution_degc", model.package->resolution_degc);
  }
}

void CheckSensors(const Model& model, Findings& f) {
  f.NotNegative("model.accel.noise_density_g_per_rthz", model.accel.noise_density_g_per_rthz);
  f.Positive("model.speaker.pa_per_v", model.speaker.pa_per_v);
  if (!model.gyro) return;
  f.Finite("model.gyro.reference_degc", model.gyro->reference_degc);
  f.NotNegative("model.gyro.noise_density_dps_per_rthz", model.gyro->noise_density_dps_per_rthz);
  f.NotNegative("model.gyro.flicker_dps", model.gyro->flicker_dps);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double coefficient : model.gyro->zro_dps[axis]) {
      f.Finite(fmt::format("model.gyro.zro_{}_dps", "xyz"[axis]), coefficient);
    }
  }
}

void CheckValues(const ParameterInfo& parameter, const std::string& key,
                 const std::vector<double>& values, Findings& f) {
  if (values.size() != parameter.defaults.size()) {
    f.Add(key, fmt::format("must hold {} value{}, holds {}", parameter.defaults.size(),
                           parameter.defaults.size() == 1 ? "" : "s", values.size()));
    return;
  }
  for (const double value : values) {
    if (parameter.positive) {
      f.Require(std::isfinite(value) && value > 0, key, "> 0", value);
    } else if (parameter.not_negative) {
      f.Require(std::isfinite(value) && value >= 0, key, ">= 0", value);
    } else {
      f.Finite(key, value);
    }
  }
}

void CheckParameters(const std::string& id, const TermParameters& stated, Findings& f) {
  const std::string table = fmt::format("model.term.\"{}\"", id);
  const TermInfo* info = FindTerm(id);
  if (!info) {
    f.Add(table, fmt::format("names no known term; nearest is \"{}\"", NearestTerm(id)));
    return;
  }
  for (const auto& [name, values] : stated) {
    const std::string key = table + "." + name;
    const auto known = std::ranges::find(info->parameters, name, &ParameterInfo::name);
    if (known != info->parameters.end()) {
      CheckValues(*known, key, values, f);
      continue;
    }
    std::vector<std::string_view> names;
    for (const ParameterInfo& parameter : info->parameters) names.push_back(parameter.name);
    f.Add(key, fmt::format("is no parameter of this term; it has {}", fmt::join(names, ", ")));
  }
}

void CheckTerms(const Model& model, Findings& f) {
  for (auto id = model.terms.begin(); id != model.terms.end(); ++id) {
    if (!FindTerm(*id)) {
      f.Add("model.terms",
            fmt::format("names the unknown term \"{}\"; nearest is \"{}\"", *id, NearestTerm(*id)));
    } else if (std::find(model.terms.begin(), id, *id) != id) {
      f.Add("model.terms", fmt::format("names \"{}\" twice", *id));
    }
  }
  for (const auto& [id, stated] : model.term) CheckParameters(id, stated, f);
}

}  // namespace

std::vector<ModelError> FindErrors(const Model& model) {
  Findings findings;
  CheckHeat(model, findings);
  CheckSensors(model, findings);
  CheckTerms(model, findings);
  return findings.Take();
}

Status Validate(const Model& model) {
  const std::vector<ModelError> errors = FindErrors(model);
  if (errors.empty()) return {};
  std::vector<std::string_view> messages;
  for (const ModelError& error : errors) messages.push_back(error.message);
  return Fail(Error::Kind::kConfig, fmt::format("{}", fmt::join(messages, "\n")));
}

}  // namespace zrobench::physics
