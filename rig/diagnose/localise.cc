#include "rig/diagnose/localise.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace zrobench::diagnose {
namespace {

constexpr double kVisible = 1;  ///< standard deviations of a block
constexpr double kJoin_s = 60;  ///< stretches closer than this are one

std::string NameOf(std::size_t channel) {
  return std::string(kChannelNames[Index(kMeasuredChannel[channel])]);
}

double Scatter(const Noise& noise, std::size_t channel) {
  if (channel == kPlateShown) return noise.thermal.plate_k;
  if (channel == kDieShown) return noise.thermal.die_k;
  const GyroNoise& gyro = noise.gyro[channel - kRateX];
  return std::hypot(gyro.white_dps, gyro.flicker_dps);
}

using Change = std::vector<std::array<Eigen::ArrayXd, kMeasured>>;

/// What the accepted effects add to each channel of each run.
Change EffectsOf(const Problem& problem, const SearchResult& search) {
  const Fitted& fit = search.best;
  Change change(problem.series.size());
  for (std::size_t run = 0; run < change.size(); ++run) {
    for (Eigen::ArrayXd& c : change[run]) {
      c = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(problem.series[run].blocks()));
    }
  }
  Point without = fit.point;
  bool thermal = false;
  // What the station's simulation knows is no mismatch: it stands in front.
  for (std::size_t e = search.known(); e < fit.hypothesis.effects.size(); ++e) {
    const Effect& effect = fit.hypothesis.effects[e];
    if (IsThermal(*effect.info)) {
      thermal = true;
      for (const Knob& knob : EffectKnobs(effect)) knob.of(without) = 0;
      continue;
    }
    const std::vector<double> values = fit.Coefficients(e);
    const std::vector<RateResponse> responses =
        RateResponses(effect, problem, fit.point.model, fit.at);
    for (std::size_t k = 0; k < values.size(); ++k) {
      for (std::size_t run = 0; run < change.size(); ++run) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Eigen::ArrayXd& one = responses[k].rates[run][axis];
          if (one.size() > 0) change[run][kRateX + axis] += values[k] * one;
        }
      }
    }
  }
  for (std::size_t run = 0; thermal && run < change.size(); ++run) {
    const Series& series = problem.series[run];
    const ThermalPath with =
        Simulate(fit.point.model, fit.point.die_offset_k, problem.drive, series);
    const ThermalPath lacking =
        Simulate(without.model, without.die_offset_k, problem.drive, series);
    change[run][kPlateShown] = with.plate_shown - lacking.plate_shown;
    change[run][kDieShown] = with.die_shown - lacking.die_shown;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!problem.measured[kRateX + axis]) continue;
      change[run][kRateX + axis] += fit.slopes_dps_per_k[run][axis] * (with.die - lacking.die);
    }
  }
  return change;
}

/// Of the dictionary's fit, where nothing in the catalogue is accepted; whitened units.
Change LeftoverOf(const Problem& problem, const Leftover& leftover) {
  Change change(problem.series.size());
  Eigen::Index first = 0;
  for (std::size_t run = 0; run < change.size(); ++run) {
    const auto blocks = static_cast<Eigen::Index>(problem.series[run].blocks());
    for (Eigen::ArrayXd& c : change[run]) {
      c = leftover.fitted.segment(first, blocks).array();
      first += blocks;
    }
  }
  return change;
}

std::vector<std::pair<double, double>> Stretches(const Series& series,
                                                 const std::vector<bool>& here) {
  std::vector<std::pair<double, double>> stretches;
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (!here[i]) continue;
    const double begin = series.block_start_s(i), end = series.block_start_s(i + 1);
    if (!stretches.empty() && begin - stretches.back().second <= kJoin_s) {
      stretches.back().second = end;
    } else {
      stretches.emplace_back(begin, end);
    }
  }
  return stretches;
}

}  // namespace

PerChannel NoiseFloor(const Problem& problem, const Noise& noise) {
  PerChannel floor;
  for (std::size_t c = 0; c < kMeasured; ++c) {
    if (problem.measured[c]) floor[NameOf(c)] = Scatter(noise, c);
  }
  return floor;
}

void Localise(const Problem& problem, const Noise& noise, const SearchResult& search,
              const Leftover& leftover, Mismatch& mismatch) {
  const bool named = !search.accepted.empty();
  const Change change = named ? EffectsOf(problem, search) : LeftoverOf(problem, leftover);
  std::set<std::size_t> touched;
  for (std::size_t run = 0; run < change.size(); ++run) {
    const Series& series = problem.series[run];
    std::vector<bool> here(series.blocks());
    for (std::size_t c = 0; c < kMeasured; ++c) {
      if (!problem.measured[c]) continue;
      const double scale = named ? Scatter(noise, c) : 0.3;
      for (std::size_t i = 0; i < here.size(); ++i) {
        if (std::fabs(change[run][c][static_cast<Eigen::Index>(i)]) < kVisible * scale) continue;
        here[i] = true;
        touched.insert(c);
      }
    }
    if (auto found = Stretches(series, here); !found.empty()) {
      mismatch.intervals_s[series.name] = std::move(found);
    }
  }
  for (const std::size_t c : touched) mismatch.channels.push_back(NameOf(c));
  const double energy = search.base.residual.squaredNorm();
  mismatch.share_of_energy = energy > 0 ? 1 - search.best.residual.squaredNorm() / energy : 0;
}

}  // namespace zrobench::diagnose
