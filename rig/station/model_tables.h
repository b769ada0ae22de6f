#pragma once
#include "core/toml_reader.h"
#include "rig/physics/model.h"

namespace zrobench {

/// Reads [model] into `model`. Board, package and gyro exist only where the file has their tables;
/// other missing keys keep their nominal value.
void ReadModel(TableReader reader, physics::Model* model);

}  // namespace zrobench
