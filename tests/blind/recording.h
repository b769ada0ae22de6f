#pragma once
// A case folder read back as its analyser sees it: columns and station file, nothing else.
#include <Eigen/Core>
#include <filesystem>

#include "tests/blind/respond.h"

namespace zrobench::blind {

struct Recording {
  Bench bench;              ///< nominal values in `nominal` and `actual`; instruments as stated
  Campaign campaign;        ///< stimuli as far as columns tell
  Eigen::VectorXd stacked;  ///< block means; blank rows bridged
};

/// Throws std::runtime_error naming the file when it cannot be read or has not kRunRows rows.
Recording ReadCase(const std::filesystem::path& folder);

}  // namespace zrobench::blind
