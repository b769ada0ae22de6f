#pragma once
#include <nlohmann/json_fwd.hpp>

#include "rig/diagnose/diagnosis.h"

namespace zrobench::diagnose {

/// The object that `diagnose --json` prints (docs/formats.md, "Diagnosis").
nlohmann::ordered_json ToJson(const Diagnosis& diagnosis);

}  // namespace zrobench::diagnose
