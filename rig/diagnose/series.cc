#include "rig/diagnose/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace zrobench::diagnose {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double MedianSpacing_s(const CaseRun& run) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < run.rows.size(); ++i) {
    gaps.push_back(run.rows[i][Channel::kTime] - run.rows[i - 1][Channel::kTime]);
  }
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

/// Measured: a row stands for the time since the row before it. Command: for the time to the next.
enum class RowTime { kBefore, kAfter };

/// Means of a channel over cells of `width_s`; NaN where a cell holds no value.
Eigen::ArrayXd CellMeans(const CaseRun& run, Channel channel, double width_s, std::size_t cells,
                         RowTime time) {
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(cells));
  Eigen::ArrayXd count = sum;
  const double start_s = run.rows.front()[Channel::kTime];
  for (const Row& row : run.rows) {
    if (std::isnan(row[channel])) continue;
    const double at = (row[Channel::kTime] - start_s) / width_s;
    const double cell = time == RowTime::kBefore ? std::ceil(at - 1e-9) - 1 : std::floor(at + 1e-9);
    const auto i = static_cast<Eigen::Index>(std::max(cell, 0.0));
    if (i >= sum.size()) continue;
    sum[i] += row[channel];
    count[i] += 1;
  }
  return (count > 0).select(sum / count.max(1), kNan);
}

/// Empty cells take the value before them; leading ones the first there is, or `rest`.
void Hold(Eigen::ArrayXd& values, double rest) {
  double held = rest;
  for (const double v : values) {
    if (!std::isnan(v)) {
      held = v;
      break;
    }
  }
  for (double& v : values) held = v = std::isnan(v) ? held : v;
}

Eigen::ArrayXd FineInput(const CaseRun& run, const Grid& grid, Channel channel, double rest) {
  const double span_s = run.rows.back()[Channel::kTime] - run.rows.front()[Channel::kTime];
  const auto steps = static_cast<std::size_t>(std::floor(span_s / grid.step_s + 1e-9));
  const bool command =
      channel == Channel::kToneHz || channel == Channel::kToneV || channel == Channel::kToneSpl;
  Eigen::ArrayXd fine =
      CellMeans(run, channel, grid.step_s, steps, command ? RowTime::kAfter : RowTime::kBefore);
  Hold(fine, rest);
  return fine;
}

/// rms pressure at the package.
double TonePa(double spl_db, double volts, double hz, double pa_per_v) {
  if (!(hz > 0)) return 0;
  if (!std::isnan(spl_db)) return PaFromSplDb(spl_db);
  return std::isnan(volts) ? 0 : volts * pa_per_v;
}

std::vector<physics::Inputs> InputsOf(const CaseRun& run, const Grid& grid,
                                      const physics::Model& model) {
  const auto fine = [&](Channel channel, double rest) {
    return FineInput(run, grid, channel, rest);
  };
  const Eigen::ArrayXd drive = fine(Channel::kDrive, 0), supply = fine(Channel::kSupply, 3.3);
  const Eigen::ArrayXd hz = fine(Channel::kToneHz, 0), volts = fine(Channel::kToneV, kNan);
  const Eigen::ArrayXd spl = fine(Channel::kToneSpl, kNan);
  const Eigen::ArrayXd ax = fine(Channel::kAccelX, 0), ay = fine(Channel::kAccelY, 0),
                       az = fine(Channel::kAccelZ, 1);
  std::vector<physics::Inputs> inputs(static_cast<std::size_t>(drive.size()));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    inputs[i].drive_pct = drive[k];
    inputs[i].supply_v = supply[k];
    inputs[i].tone_hz = hz[k];
    inputs[i].tone_pa = TonePa(spl[k], volts[k], hz[k], model.speaker.pa_per_v);
    inputs[i].gravity_g = {ax[k], ay[k], az[k]};
    inputs[i].age_days = (run.started_h + static_cast<double>(i) * grid.step_s / 3600) / 24;
  }
  return inputs;
}

}  // namespace

Grid Grid::For(const std::vector<CaseRun>& runs) {
  double spacing_s = 0;
  for (const CaseRun& run : runs) spacing_s = std::max(spacing_s, MedianSpacing_s(run));
  if (spacing_s <= 1) return {1, 5};
  if (spacing_s <= 5) return {spacing_s, static_cast<std::size_t>(std::ceil(5 / spacing_s))};
  const double steps = std::ceil(spacing_s / 5);
  return {spacing_s / steps, static_cast<std::size_t>(steps)};
}

std::vector<bool> Series::Measured(std::size_t channel) const {
  std::vector<bool> here;
  for (const double value : block[channel]) here.push_back(!std::isnan(value));
  return here;
}

Series Resample(const CaseRun& run, const Grid& grid, const Station& station) {
  Series series;
  series.name = run.name;
  series.grid = grid;
  series.start_s = run.rows.front()[Channel::kTime];
  series.mean_rows = station.recording.mean_rows;
  series.inputs = InputsOf(run, grid, station.model);
  const std::size_t blocks = series.inputs.size() / grid.steps_per_block;
  series.inputs.resize(blocks * grid.steps_per_block);
  series.plate_in_degc = FineInput(run, grid, Channel::kPlate, station.model.ambient_degc);
  for (std::size_t i = 0; i < kMeasured; ++i) {
    series.block[i] = CellMeans(run, kMeasuredChannel[i], grid.block_s(), blocks, RowTime::kBefore);
  }
  return series;
}

}  // namespace zrobench::diagnose
