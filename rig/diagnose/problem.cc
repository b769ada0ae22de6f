#include "rig/diagnose/problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace zrobench::diagnose {
namespace {

/// Gaps are bridged linearly; the ends are held.
Eigen::ArrayXd Bridged(Eigen::ArrayXd values) {
  Eigen::Index last = -1;
  for (Eigen::Index k = 0; k <= values.size(); ++k) {
    if (k < values.size() && std::isnan(values[k])) continue;
    for (Eigen::Index i = last + 1; i < k; ++i) {
      const bool first = last < 0, end = k == values.size();
      const double share = static_cast<double>(i - last) / static_cast<double>(k - last);
      values[i] = first && end ? 0
                  : first      ? values[k]
                  : end        ? values[last]
                               : values[last] + share * (values[k] - values[last]);
    }
    last = k;
  }
  return values;
}

/// Values at the ends of fine steps from block means: linear between the blocks' middles.
Eigen::ArrayXd FineOf(const Eigen::ArrayXd& blocks, std::size_t per_block) {
  const auto n = static_cast<Eigen::Index>(per_block);
  Eigen::ArrayXd fine(blocks.size() * n);
  for (Eigen::Index i = 0; i < fine.size(); ++i) {
    const double at = (static_cast<double>(i) + 1) / static_cast<double>(per_block) - 0.5;
    const double inside = std::clamp(at, 0.0, static_cast<double>(blocks.size() - 1));
    const auto low = std::min(static_cast<Eigen::Index>(inside), blocks.size() - 1);
    const auto high = std::min(low + 1, blocks.size() - 1);
    fine[i] = blocks[low] + (inside - static_cast<double>(low)) * (blocks[high] - blocks[low]);
  }
  return fine;
}

Knob Logarithmic(std::string name, std::function<double&(Point&)> of) {
  return {std::move(name), std::move(of), true, 0.7, 1e-3, 1};
}
Knob Additive(std::string name, double prior_sd, std::function<double&(Point&)> of) {
  return {std::move(name), std::move(of), false, prior_sd, 1e-2, 1};
}

/// Whether the drive ever heats (sign 1) or cools (-1).
bool EverDrives(const Problem& problem, double sign) {
  return std::ranges::any_of(problem.series, [sign](const Series& s) {
    return std::ranges::any_of(s.inputs,
                               [sign](const physics::Inputs& i) { return sign * i.drive_pct > 0; });
  });
}

}  // namespace

Problem Problem::Of(const Case& loaded) {
  Problem problem;
  problem.nominal = loaded.station.model;
  problem.known = std::exchange(problem.nominal.terms, {});
  const Grid grid = Grid::For(loaded.runs);
  for (const CaseRun& run : loaded.runs) {
    problem.series.push_back(Resample(run, grid, loaded.station));
  }
  std::erase_if(problem.series, [](const Series& s) { return s.blocks() == 0; });
  const bool plate = loaded.Has(Channel::kPlate);
  problem.drive = !plate                        ? Drive::kNothing
                  : loaded.Has(Channel::kDrive) ? Drive::kHeat
                                                : Drive::kPlate;
  for (std::size_t c = 0; c < kMeasured; ++c) {
    problem.measured[c] = std::ranges::any_of(
        problem.series, [&](const Series& s) { return (!s.block[c].isNaN()).any(); });
  }
  if (!problem.measured[kDieShown]) {
    problem.nominal.board.reset();
    problem.nominal.package.reset();
  }
  return problem;
}

Problem Problem::Only(const std::vector<std::size_t>& runs) const {
  Problem some = *this;
  some.series.clear();
  for (const std::size_t run : runs) some.series.push_back(series[run]);
  return some;
}

Eigen::Index Problem::rows() const {
  std::size_t blocks = 0;
  for (const Series& s : series) blocks += s.blocks();
  return static_cast<Eigen::Index>(blocks * kMeasured);
}

Eigen::ArrayXd Problem::X(const Eigen::ArrayXd& die_degc) const {
  return (die_degc - nominal.gyro.value_or(physics::GyroModel{}).reference_degc) / kSpan_k;
}

void Knob::Move(Point& point, double step) const {
  double& value = of(point);
  value = logarithmic ? value * std::exp(step) : value + step * unit;
}

double Knob::Distance(const Point& point, const Point& nominal) const {
  Point a = point, b = nominal;
  return logarithmic ? std::log(of(a) / of(b)) : (of(a) - of(b)) / unit;
}

std::vector<Knob> BaseKnobs(const Problem& problem) {
  std::vector<Knob> knobs;
  if (problem.drive == Drive::kNothing) return knobs;
  // Only ratios show without a measurement of heat: the plate's capacity stays as stated.
  if (problem.drive == Drive::kHeat) {
    if (EverDrives(problem, 1)) {
      knobs.push_back(Logarithmic("model.plate.heater_w",
                                  [](Point& p) -> double& { return p.model.plate.heater_w; }));
    }
    if (EverDrives(problem, -1)) {
      knobs.push_back(Logarithmic("model.plate.cooler_w",
                                  [](Point& p) -> double& { return p.model.plate.cooler_w; }));
    }
    knobs.push_back(Logarithmic("model.plate.to_ambient_w_per_k", [](Point& p) -> double& {
      return p.model.plate.to_ambient_w_per_k;
    }));
  }
  knobs.push_back(
      Additive("model.ambient.degc", 3, [](Point& p) -> double& { return p.model.ambient_degc; }));
  if (problem.nominal.board) {
    if (problem.drive == Drive::kHeat) {
      knobs.push_back(Logarithmic("model.board.heat_capacity_j_per_k", [](Point& p) -> double& {
        return p.model.board->heat_capacity_j_per_k;
      }));
    }
    knobs.push_back(Logarithmic("model.board.to_plate_w_per_k", [](Point& p) -> double& {
      return p.model.board->to_plate_w_per_k;
    }));
    knobs.push_back(Logarithmic("model.board.to_ambient_w_per_k", [](Point& p) -> double& {
      return p.model.board->to_ambient_w_per_k;
    }));
  }
  if (problem.nominal.package) {
    knobs.push_back(Logarithmic("model.package.time_constant_s", [](Point& p) -> double& {
      return p.model.package->time_constant_s;
    }));
  }
  if (problem.measured[kDieShown]) {
    knobs.push_back(
        Additive("die sensor offset", 3, [](Point& p) -> double& { return p.die_offset_k; }));
  }
  return knobs;
}

std::vector<Knob> SoundKnobs() {
  std::vector<Knob> knobs;
  const auto add = [&](const char* key, std::size_t i, double prior_sd) {
    Knob knob =
        Logarithmic(std::string("acoustic.resonance.") + key, [key, i](Point& point) -> double& {
          return point.model.term.at("acoustic.resonance").at(key)[i];
        });
    knob.prior_sd = prior_sd;
    knob.probe = prior_sd / 100;
    knob.sound = true;
    knobs.push_back(std::move(knob));
  };
  constexpr double kFromASweep = 5e-4;
  for (std::size_t axis = 0; axis < 3; ++axis) add("resonance_hz", axis, kFromASweep);
  add("q", 0, 0.3);
  return knobs;
}

Filters::Filters(const Problem& problem, const Point& about, const Noise& noise)
    : problem_(problem) {
  Eigen::Index row = 0;
  for (const Series& s : problem.series) {
    first_.push_back(row);
    row += static_cast<Eigen::Index>(s.blocks() * kMeasured);
    if (problem.drive != Drive::kNothing) {
      thermal_.emplace_back(about.model, problem.drive, noise.thermal, s);
    }
    std::vector<NoiseWhitener> axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axes.emplace_back(noise.gyro[axis], problem.block_s(), s.Measured(kRateX + axis));
    }
    rate_.push_back(std::move(axes));
  }
}

Evaluated Filters::Evaluate(const Point& point) const {
  Evaluated at;
  for (std::size_t run = 0; run < problem_.series.size(); ++run) {
    const Series& s = problem_.series[run];
    if (problem_.drive == Drive::kNothing) {
      at.die.push_back(Bridged(s.block[kDieShown]));
      at.die_fine.push_back(FineOf(at.die.back(), s.grid.steps_per_block));
      continue;
    }
    at.path.push_back(Simulate(point.model, point.die_offset_k, problem_.drive, s));
    const ThermalPath& path = at.path.back();
    at.filtered.push_back(thermal_[run].Run(s.block[kPlateShown] - path.plate_shown,
                                            s.block[kDieShown] - path.die_shown));
    const Eigen::ArrayXd& error = at.filtered.back().die_error;
    at.die.push_back(path.die + error);
    at.die_fine.push_back(path.die_fine + FineOf(error, s.grid.steps_per_block));
  }
  return at;
}

Eigen::VectorXd::SegmentReturnType Filters::Segment(Eigen::VectorXd& stack, std::size_t run,
                                                    std::size_t channel) const {
  const auto blocks = static_cast<Eigen::Index>(problem_.series[run].blocks());
  return stack.segment(first_[run] + static_cast<Eigen::Index>(channel) * blocks, blocks);
}

Eigen::VectorXd Filters::Residual(const Evaluated& at) const {
  Eigen::VectorXd stack = Eigen::VectorXd::Zero(problem_.rows());
  for (std::size_t run = 0; run < problem_.series.size(); ++run) {
    if (!at.filtered.empty()) {
      Segment(stack, run, kPlateShown) = at.filtered[run].plate.matrix();
      Segment(stack, run, kDieShown) = at.filtered[run].die.matrix();
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Segment(stack, run, kRateX + axis) =
          rate_[run][axis].Whiten(problem_.series[run].block[kRateX + axis]).matrix();
    }
  }
  return stack;
}

Eigen::VectorXd Filters::TemperatureResidual(const Evaluated& at) const {
  Eigen::VectorXd stack = Eigen::VectorXd::Zero(problem_.rows());
  for (std::size_t run = 0; run < problem_.series.size(); ++run) {
    const Series& s = problem_.series[run];
    const ThermalFilter::Output left =
        thermal_[run].Run(s.block[kPlateShown] - at.path[run].plate_shown,
                          s.block[kDieShown] - at.path[run].die_shown);
    Segment(stack, run, kPlateShown) = left.plate.matrix();
    Segment(stack, run, kDieShown) = left.die.matrix();
  }
  return stack;
}

Eigen::VectorXd Filters::ThermalColumn(const Evaluated& at, const Evaluated& moved,
                                       const Slopes& slope_dps_per_k) const {
  Eigen::VectorXd stack = Eigen::VectorXd::Zero(problem_.rows());
  for (std::size_t run = 0; run < problem_.series.size(); ++run) {
    const ThermalFilter::Output change =
        thermal_[run].Run(moved.path[run].plate_shown - at.path[run].plate_shown,
                          moved.path[run].die_shown - at.path[run].die_shown);
    Segment(stack, run, kPlateShown) = change.plate.matrix();
    Segment(stack, run, kDieShown) = change.die.matrix();
    // What the sensor shows more, the filter takes off its estimate of the error.
    const Eigen::ArrayXd die = moved.path[run].die - at.path[run].die - change.die_error;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (slope_dps_per_k.empty() || !problem_.measured[kRateX + axis]) continue;
      Segment(stack, run, kRateX + axis) =
          rate_[run][axis].Whiten(slope_dps_per_k[run][axis] * die).matrix();
    }
  }
  return stack;
}

Eigen::VectorXd Filters::RateColumn(std::size_t axis,
                                    const std::vector<Eigen::ArrayXd>& rates) const {
  Eigen::VectorXd stack = Eigen::VectorXd::Zero(problem_.rows());
  for (std::size_t run = 0; run < problem_.series.size(); ++run) {
    if (rates[run].size() == 0) continue;
    Segment(stack, run, kRateX + axis) = rate_[run][axis].Whiten(rates[run]).matrix();
  }
  return stack;
}

double Filters::thermal_log_determinant() const {
  double sum = 0;
  for (const ThermalFilter& filter : thermal_) sum += filter.log_determinant();
  return sum;
}

}  // namespace zrobench::diagnose
