#pragma once
// The rig's own idea of the true offset: long averages of the raw gyro, still and silent.
#include <array>
#include <optional>
#include <span>

#include "rig/run/evidence.h"

namespace zrobench {

struct Reference {
  std::array<double, 3> zro_dps{};
  std::array<double, 3> uncertainty_k2_dps{};
  std::uint64_t first_us = 0, last_us = 0;
};

/// Value at `degc` of a line fitted over all quiet seconds within 1 degC of it; its expanded
/// uncertainty comes from the scatter of 5 s blocks about that line (Student's t for the few blocks
/// there are), so slow noise counts. Nothing when there are fewer than 4 blocks, or when they lie
/// on one side of `degc` only.
std::optional<Reference> ReferenceAt(std::span<const Second> seconds, double degc);
inline std::optional<Reference> ReferenceAt(const Evidence& evidence, double degc) {
  return ReferenceAt(evidence.seconds, degc);
}

}  // namespace zrobench
