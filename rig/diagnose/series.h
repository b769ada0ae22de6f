#pragma once
// One power-on on a regular grid: inputs in fine steps, measured channels as means over blocks.
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "rig/diagnose/case.h"
#include "rig/physics/rig_model.h"

namespace zrobench::diagnose {

/// Channels that a model predicts, in the order in which they are stacked.
enum Measured : std::size_t { kPlateShown, kDieShown, kRateX, kRateY, kRateZ, kMeasured };
inline constexpr std::array<Channel, kMeasured> kMeasuredChannel = {
    Channel::kPlate, Channel::kImuTemperature, Channel::kGyroX, Channel::kGyroY, Channel::kGyroZ};

/// The grid all runs of a case share.
struct Grid {
  double step_s = 1;                ///< inputs are held this long
  std::size_t steps_per_block = 5;  ///< measured channels are compared in means of so many steps

  double block_s() const { return step_s * static_cast<double>(steps_per_block); }
  /// From the runs' own row spacing: 1 s steps in 5 s blocks for rows of a second or less, a row a
  /// block where they are slower than that.
  static Grid For(const std::vector<CaseRun>& runs);
};

struct Series {
  std::string name;
  Grid grid;
  double start_s = 0;                   ///< of the first block, in the recording's time
  bool mean_rows = true;                ///< else a block's mean is that of instants at step ends
  std::vector<physics::Inputs> inputs;  ///< a fine step each
  Eigen::ArrayXd plate_in_degc;         ///< a fine step each; where a plate drives without a drive
  std::array<Eigen::ArrayXd, kMeasured> block;  ///< block means; NaN where nothing was measured

  /// Which blocks of a channel hold a value.
  std::vector<bool> Measured(std::size_t channel) const;
  std::size_t blocks() const { return static_cast<std::size_t>(block[0].size()); }
  double block_start_s(std::size_t i) const {
    return start_s + static_cast<double>(i) * grid.block_s();
  }
};

/// Inputs that the recording lacks stay at rest (no tone, 3.3 V, gravity along z).
/// `pa_per_v` gives the sound of tone_v where tone_spl_db is absent.
Series Resample(const CaseRun& run, const Grid& grid, const Station& station);

}  // namespace zrobench::diagnose
