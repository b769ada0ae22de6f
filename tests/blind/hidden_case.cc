#include "tests/blind/hidden_case.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMostStructuralLambda = 4;
constexpr double kTolerance = 0.02;  // of a wanted noncentrality
constexpr std::array<std::string_view, kChannels> kColumns = {
    "plate_degc", "imu_degc", "gyro_x_dps", "gyro_y_dps", "gyro_z_dps"};

// Effects that stay what they are when made very small.
bool FitForStructure(const Kind& kind, bool knows_rectification) {
  if (NeedsRectification(kind.id)) return false;
  if (ExcludesRectification(kind.id) && knows_rectification) return false;
  for (const std::string_view id : {"thermal.saturation", "bus.stale_command", "time.drops",
                                    "thermal.die_sensor_hold", "time.sample_hold"}) {
    if (kind.id == id) return false;
  }
  return true;
}

std::vector<Effect> Together(std::vector<Effect> effects, const std::vector<Hidden>& hidden) {
  for (const Hidden& one : hidden) effects.push_back(one.effect);
  return effects;
}

// The change that `added` makes to a bench which has `present` already.
class Difference {
 public:
  Difference(const Bench& bench, const Campaign& campaign, const std::vector<Effect>& present)
      : bench_(bench),
        campaign_(campaign),
        present_(present),
        paths_(Heat(bench.actual, bench.solids, present, campaign)),
        without_(Stack(Shown(bench.actual, campaign, paths_, present))) {}

  const VectorXd& without() const { return without_; }

  VectorXd operator()(const std::vector<Effect>& added) const {
    std::vector<Effect> all = present_;
    bool heat = false;
    for (const Effect& effect : added) {
      all.push_back(effect);
      heat = heat || KindOf(effect.id).stage == Stage::kThermal;
    }
    const Paths heated = heat ? Heat(bench_.actual, bench_.solids, all, campaign_) : Paths();
    return Stack(Shown(bench_.actual, campaign_, heat ? heated : paths_, all)) - without_;
  }

 private:
  const Bench& bench_;
  const Campaign& campaign_;
  const std::vector<Effect>& present_;
  Paths paths_;
  VectorXd without_;
};

// Secant on the logarithms: noncentrality is a power of strength, near two for most effects.
void Scale(Hidden& hidden, double wanted, const Difference& difference, const Yardstick& yard) {
  const double most = KindOf(hidden.effect.id).most;
  double power = 2;
  double last_strength = 0;
  double last_lambda = 0;
  for (int round = 0; round < 12; ++round) {
    hidden.lambda = yard.Lambda(difference({hidden.effect}));
    const double strength = std::abs(hidden.effect.strength);
    if (std::abs(hidden.lambda / wanted - 1) < kTolerance) return;
    if (hidden.lambda <= 0) {
      hidden.effect.strength *= 2;
      continue;
    }
    if (last_lambda > 0 && strength != last_strength) {
      power = std::clamp(std::log(hidden.lambda / last_lambda) / std::log(strength / last_strength),
                         0.7, 8.0);
    }
    last_strength = strength;
    last_lambda = hidden.lambda;
    const double factor = std::clamp(std::pow(wanted / hidden.lambda, 1 / power), 0.02, 20.0);
    hidden.effect.strength =
        std::copysign(std::min(strength * factor, most), hidden.effect.strength);
    if (strength == most && factor > 1) return;  // as strong as a bench can be
  }
}

std::vector<Effect> DrawStructure(const CaseOrder& order, const Bench& bench, const Yardstick& yard,
                                  Draw& draw) {
  std::vector<Effect> effects;
  const int count = 2 + draw.Below(2);
  while (static_cast<int>(effects.size()) < count) {
    const Kind& kind =
        KnownKinds()[static_cast<std::size_t>(draw.Below(static_cast<int>(KnownKinds().size())))];
    const bool taken = Find(effects, kind.id) ||
                       std::ranges::any_of(
                           order.hide, [&kind](const auto& hide) { return hide.first == kind.id; });
    if (taken || !FitForStructure(kind, bench.knows_rectification)) continue;
    Effect effect = DrawEffect(kind, draw);
    const MatrixXd columns = yard.ColumnsOf(kind, {effect.shape});
    const Eigen::Vector3d axes(effect.axes[0], effect.axes[1], effect.axes[2]);
    const double lambda =
        columns.cols() == 3 ? (columns * axes).squaredNorm() : columns.squaredNorm();
    const double wanted = draw.Uniform(0.2, 1.0);
    if (lambda < 1e-9) continue;
    const double factor = std::sqrt(wanted / lambda);
    if (factor * kind.typical > kind.most) continue;
    effect.strength *= factor;
    effects.push_back(std::move(effect));
  }
  return effects;
}

// Shrinks what can be shrunk until no choice of nominal values leaves a visible misfit.
void Settle(HiddenCase& made, const Campaign& campaign, const Yardstick& yard) {
  for (int round = 0; round < 6; ++round) {
    made.structural_lambda = yard.LambdaOfMisfit(
        Respond(made.bench.actual, made.bench.solids, made.structural, campaign));
    if (made.structural_lambda <= kMostStructuralLambda) return;
    const double factor = 0.85 * std::sqrt(kMostStructuralLambda / made.structural_lambda);
    for (Effect& effect : made.structural) effect.strength *= factor;
    made.bench.solids.convection_w *= factor;
    made.bench.solids.radiation_m2 *= factor;
    made.bench.solids.plate_conductance_w_per_k /= factor;
    made.bench.solids.board_conductance_w_per_k /= factor;
  }
}

void Localise(HiddenCase& made, const VectorXd& projected) {
  constexpr Index kWindow_s = 300;
  constexpr Index kWindowBlocks = kWindow_s / kBlockRows;
  const auto at = [&](Index run, Index block, Index channel) {
    return projected[(run * kBlocks + block) * kChannels + channel];
  };
  std::array<double, kChannels> energy{};
  made.intervals_s.assign(made.schedules.size(), {});
  for (Index run = 0; run < static_cast<Index>(made.schedules.size()); ++run) {
    auto& intervals = made.intervals_s[static_cast<std::size_t>(run)];
    for (Index first = 0; first < kBlocks; first += kWindowBlocks) {
      bool active = false;
      for (Index channel = 0; channel < kChannels; ++channel) {
        double sum = 0;
        for (Index b = first; b < first + kWindowBlocks; ++b)
          sum += std::pow(at(run, b, channel), 2);
        energy[static_cast<std::size_t>(channel)] += sum;
        active = active || sum > 1;
      }
      if (!active) continue;
      const int begin = static_cast<int>(first * kBlockRows);
      if (!intervals.empty() && intervals.back().second == begin) {
        intervals.back().second = begin + kWindow_s;
      } else {
        intervals.emplace_back(begin, begin + kWindow_s);
      }
    }
  }
  for (std::size_t channel = 0; channel < kChannels; ++channel) {
    if (energy[channel] > 0.2 * projected.squaredNorm()) {
      made.channels.emplace_back(kColumns[channel]);
    }
  }
}

void Measure(HiddenCase& made, const Difference& difference, const Yardstick& yard) {
  std::vector<Effect> all;
  std::vector<VectorXd> alone;
  for (Hidden& hidden : made.hidden) {
    all.push_back(hidden.effect);
    alone.push_back(yard.Project(difference({hidden.effect})));
    hidden.lambda = alone.back().squaredNorm();
  }
  const VectorXd joint = yard.Project(difference(all));
  made.joint_lambda = joint.squaredNorm();
  Localise(made, joint);
  std::vector<std::string> ids;
  for (const Effect& effect : all) ids.push_back(effect.id);
  for (std::size_t i = 0; i < made.hidden.size(); ++i) {
    made.hidden[i].nearest = yard.NearestAlike(alone[i], ids);
  }
  if (alone.size() == 2) made.cosine = alone[0].dot(alone[1]) / (alone[0].norm() * alone[1].norm());
}

bool AnyHeat(const std::vector<Hidden>& hidden) {
  return std::ranges::any_of(
      hidden, [](const Hidden& one) { return KindOf(one.effect.id).stage == Stage::kThermal; });
}

void Hide(HiddenCase& made, const Yardstick& first, std::uint64_t seed) {
  const Difference early(made.bench, first.campaign(), made.structural);
  for (std::size_t i = 0; i < made.hidden.size(); ++i) {
    Scale(made.hidden[i], made.order.hide[i].second, early, first);
  }
  if (!AnyHeat(made.hidden)) return Measure(made, early, first);
  // The controller answers what is hidden: scale again on the commands it then gives.
  made.paths = CloseLoop(made.bench, made.schedules, Together(made.structural, made.hidden), seed);
  const Yardstick yard(made.bench, CampaignOf(made.schedules, made.paths));
  const Difference late(made.bench, yard.campaign(), made.structural);
  for (std::size_t i = 0; i < made.hidden.size(); ++i) {
    Scale(made.hidden[i], made.order.hide[i].second, late, yard);
  }
  Measure(made, late, yard);
}

void MoveNominals(Bench& bench, Draw& draw) {
  const auto off = [&draw](double& value) {
    value *= draw.Uniform(0, 1) < 0.5 ? draw.Uniform(0.4, 0.6) : draw.Uniform(1.6, 2.2);
  };
  BaseModel& m = bench.actual;
  for (double* value :
       {&m.plate_j_per_k, &m.board_j_per_k, &m.board_to_plate_w_per_k, &m.package_s}) {
    if (draw.Uniform(0, 1) < 0.7) off(*value);
  }
  for (auto& axis : m.zro_dps) {
    off(axis[0]);
    off(axis[1]);
  }
}

bool KnowsRectification(const CaseOrder& order, Draw& draw) {
  bool knows = draw.Uniform(0, 1) < 0.5;
  for (const auto& [id, lambda] : order.hide) {
    if (NeedsRectification(id)) knows = true;
    if (ExcludesRectification(id)) knows = false;
  }
  return knows;
}

}  // namespace

HiddenCase MakeCase(const CaseOrder& order, std::uint64_t seed) {
  Draw choices(seed, "choices");
  HiddenCase made;
  made.order = order;
  made.bench = DrawBench(Draw(seed, "bench"), KnowsRectification(order, choices));
  made.bench.instruments.flicker_dps *= order.flicker_factor;
  made.bench.instruments.draft_k *= order.draft_factor;
  if (order.foreign_nominals) MoveNominals(made.bench, choices);
  made.schedules = DrawSchedules(Draw(seed, "schedules"), made.bench);
  const Paths untouched = CloseLoop(made.bench, made.schedules, {}, seed);
  const Yardstick yard(made.bench, CampaignOf(made.schedules, untouched));
  for (const auto& [id, lambda] : order.hide) {
    made.hidden.push_back({DrawEffect(KindOf(id), choices), 0, {}});
  }
  made.structural = DrawStructure(order, made.bench, yard, choices);
  Settle(made, yard.campaign(), yard);
  if (!made.hidden.empty()) Hide(made, yard, seed);
  made.paths = CloseLoop(made.bench, made.schedules, Together(made.structural, made.hidden), seed);
  return made;
}

std::string RunText(const HiddenCase& made, std::size_t run, std::uint64_t seed) {
  const std::vector<Effect> effects = Together(made.structural, made.hidden);
  const Schedule& schedule = made.schedules[run];
  const Rows felt =
      Felt(made.bench.actual, schedule, static_cast<int>(run), made.paths[run], effects);
  return LogText(made.bench, schedule, felt, made.paths[run].command_pct, effects,
                 Draw(seed, "noise of run " + std::to_string(run)));
}

}  // namespace zrobench::blind
