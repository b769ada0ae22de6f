#pragma once
// Small recordings for the diagnosis, made by the rig's own model run forward.
#include <filesystem>
#include <string>

#include "rig/diagnose/case.h"
#include "rig/physics/model.h"

namespace zrobench::diagnose {

/// A station whose model is `nominal`, and runs in which the truth was `actual`: a closed loop
/// takes the plate through steps and ramps between 10 and 60 degC; rows of a second are means.
struct BenchRecording {
  physics::Model nominal, actual;
  int runs = 2;
  int seconds = 3600;
  std::uint64_t seed = 1;

  Case Make() const;
};

/// `loaded` as a folder of files.
void Write(const Case& loaded, const std::filesystem::path& folder);

}  // namespace zrobench::diagnose
