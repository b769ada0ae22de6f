#pragma once
#include <array>
#include <cmath>
#include <cstdint>

namespace zrobench {

/// Error of the corrector's estimate as a user of it would have met it: at each completed reading,
/// reading minus the estimate just before the reading entered the table. Beside it the error of one
/// constant offset, the first reading (a calibration at boot). The first reading counts in neither.
class ErrorTable {
 public:
  struct Axis {
    double squares = 0, max_mdps = 0;
    void Add(double mdps) {
      squares += mdps * mdps;
      max_mdps = std::fmax(max_mdps, std::fabs(mdps));
    }
  };

  /// Reading and estimate [dps].
  void Add(const float reading_dps[3], const float estimate_dps[3]) {
    if (readings_++ == 0) {
      for (std::size_t i = 0; i < 3; ++i) first_dps_[i] = reading_dps[i];
      return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      corrector_[i].Add(1e3 * (double{reading_dps[i]} - double{estimate_dps[i]}));
      constant_[i].Add(1e3 * (double{reading_dps[i]} - first_dps_[i]));
    }
  }

  std::uint64_t readings() const { return readings_; }
  double corrector_rms_mdps(std::size_t axis) const { return Rms(corrector_[axis]); }
  double corrector_max_mdps(std::size_t axis) const { return corrector_[axis].max_mdps; }
  double constant_rms_mdps(std::size_t axis) const { return Rms(constant_[axis]); }
  double constant_max_mdps(std::size_t axis) const { return constant_[axis].max_mdps; }

 private:
  /// 0 while there is no second reading.
  double Rms(const Axis& axis) const {
    return readings_ < 2 ? 0 : std::sqrt(axis.squares / static_cast<double>(readings_ - 1));
  }
  std::uint64_t readings_ = 0;
  std::array<double, 3> first_dps_{};
  std::array<Axis, 3> corrector_{}, constant_{};
};

}  // namespace zrobench
