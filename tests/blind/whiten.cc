#include "tests/blind/whiten.h"

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kThermal = 4;  // plate, board, die, draft
constexpr Index kDie = 2;
constexpr Index kDraft = 3;

// x' = A x of the linearised base model, the draft last.
MatrixXd HeatFlow(const BaseModel& model, const Instruments& noise) {
  MatrixXd flow = MatrixXd::Zero(kThermal, kThermal);
  const double pa = model.plate_to_ambient_w_per_k / model.plate_j_per_k;
  const double pb = model.board_to_plate_w_per_k / model.plate_j_per_k;
  const double bp = model.board_to_plate_w_per_k / model.board_j_per_k;
  const double ba = model.board_to_ambient_w_per_k / model.board_j_per_k;
  flow.row(0) << -pa - pb, pb, 0, pa;
  flow.row(1) << bp, -bp - ba, 0, ba;
  flow.row(2) << 0, 1 / model.package_s, -1 / model.package_s, 0;
  flow(kDraft, kDraft) = -1 / noise.draft_s;
  return flow;
}

// Transition and process noise over one block (Van Loan).
void Discretise(const MatrixXd& flow, const MatrixXd& intensity, MatrixXd& transition,
                MatrixXd& process) {
  const Index n = flow.rows();
  MatrixXd both = MatrixXd::Zero(2 * n, 2 * n);
  both.topLeftCorner(n, n) = -flow;
  both.topRightCorner(n, n) = intensity;
  both.bottomRightCorner(n, n) = flow.transpose();
  const MatrixXd grown = (both * static_cast<double>(kBlockRows)).exp();
  transition = grown.bottomRightCorner(n, n).transpose();
  process = transition * grown.topRightCorner(n, n);
}

}  // namespace

FlickerStates FlickerAs(double flicker_dps) {
  FlickerStates states;
  states.time_s = {1.5, 15, 150, 1500, 15000};
  // Densities 4 s^2 tau / (1 + (2 pi f tau)^2), a decade apart, add up to s^2 / (ln 10 f).
  states.sigma = flicker_dps * std::sqrt(std::log(10.0) / (2 * M_PI));
  return states;
}

double DensityOf(const FlickerStates& states, double hz) {
  double density = 0;
  for (const double tau : states.time_s) {
    const double turn = 2 * M_PI * hz * tau;
    density += 4 * states.sigma * states.sigma * tau / (1 + turn * turn);
  }
  return density;
}

Whitener::Whitener(const BaseModel& model, const Instruments& noise, const VectorXd& stacked,
                   std::size_t runs)
    : runs_(runs), zro_dps_(model.zro_dps) {
  Prepare(model, noise);
  Riccati(stacked);
}

void Whitener::Prepare(const BaseModel& model, const Instruments& noise) {
  const FlickerStates flicker = FlickerAs(noise.flicker_dps);
  flickers_ = static_cast<Index>(flicker.time_s.size());
  const Index n = kThermal + 3 * flickers_;
  transition_ = process_ = start_ = MatrixXd::Zero(n, n);
  MatrixXd intensity = MatrixXd::Zero(kThermal, kThermal);
  intensity(kDraft, kDraft) = 2 * noise.draft_k * noise.draft_k / noise.draft_s;
  MatrixXd transition, process;
  Discretise(HeatFlow(model, noise), intensity, transition, process);
  transition_.topLeftCorner(kThermal, kThermal) = transition;
  process_.topLeftCorner(kThermal, kThermal) = process;
  start_.topLeftCorner(kDraft, kDraft).setIdentity();
  start_(kDraft, kDraft) = noise.draft_k * noise.draft_k;
  for (Index i = kThermal; i < n; ++i) {
    const double tau = flicker.time_s[static_cast<std::size_t>((i - kThermal) % flickers_)];
    const double keep = std::exp(-kBlockRows / tau);
    // Variance of the state's mean over a block, not of the state.
    const double ratio = tau / kBlockRows;
    const double variance =
        flicker.sigma * flicker.sigma * 2 * ratio * ratio * (1 / ratio - 1 + keep);
    transition_(i, i) = keep;
    process_(i, i) = variance * (1 - keep * keep);
    start_(i, i) = variance;
  }
  const auto reading = [](double sigma, double step) {
    return (sigma * sigma + step * step / 12) / (kSubsteps * kBlockRows);
  };
  const double gyro = noise.gyro_density_dps_per_rthz;
  variance_.resize(kChannels);
  variance_ << reading(noise.plate_noise_k, noise.plate_step_k),
      reading(noise.die_noise_k, noise.die_step_k),
      VectorXd::Constant(3, gyro * gyro / (2.0 * kBlockRows));
}

VectorXd Whitener::Row(Index channel, double slope) const {
  VectorXd row = VectorXd::Zero(transition_.rows());
  if (channel == 0) row[0] = 1;
  if (channel == 1) row[kDie] = 1;
  if (channel >= 2) {
    row[kDie] = slope;
    row.segment(kThermal + (channel - 2) * flickers_, flickers_).setOnes();
  }
  return row;
}

void Whitener::Riccati(const VectorXd& stacked) {
  gains_.reserve(runs_ * kBlocks * kChannels);
  for (std::size_t run = 0; run < runs_; ++run) {
    MatrixXd covariance = start_;
    for (Index block = 0; block < kBlocks; ++block) {
      const Index at = (static_cast<Index>(run) * kBlocks + block) * kChannels;
      const double x = stacked[at + 1] - kReferenceDegc;
      for (Index channel = 0; channel < kChannels; ++channel) {
        double slope = 0;
        if (channel >= 2) {
          const auto& b = zro_dps_[static_cast<std::size_t>(channel - 2)];
          slope = b[1] + x * (2 * b[2] + x * 3 * b[3]);
          slope_.push_back(slope);
        }
        const VectorXd row = Row(channel, slope);
        const VectorXd across = covariance * row;
        const double variance = row.dot(across) + variance_[channel];
        gains_.push_back({across / variance, std::sqrt(variance)});
        covariance.noalias() -= across * across.transpose() / variance;
      }
      covariance = transition_ * covariance * transition_.transpose() + process_;
    }
  }
}

MatrixXd Whitener::Whiten(const MatrixXd& signals) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor input = signals;
  RowMajor output(input.rows(), input.cols());
  const Index n = transition_.rows();
  std::size_t step = 0;
  std::size_t slope = 0;
  Index at = 0;
  for (std::size_t run = 0; run < runs_; ++run) {
    RowMajor state = RowMajor::Zero(n, input.cols());
    for (Index block = 0; block < kBlocks; ++block) {
      for (Index channel = 0; channel < kChannels; ++channel, ++at, ++step) {
        Eigen::RowVectorXd novelty = input.row(at);
        if (channel == 0) novelty -= state.row(0);
        if (channel == 1) novelty -= state.row(kDie);
        if (channel >= 2) {
          novelty -= slope_[slope++] * state.row(kDie);
          for (Index i = 0; i < flickers_; ++i) {
            novelty -= state.row(kThermal + (channel - 2) * flickers_ + i);
          }
        }
        state.noalias() += gains_[step].gain * novelty;
        output.row(at) = novelty / gains_[step].deviation;
      }
      state.topRows(kThermal) =
          (transition_.topLeftCorner(kThermal, kThermal) * state.topRows(kThermal)).eval();
      for (Index i = kThermal; i < n; ++i) state.row(i) *= transition_(i, i);
    }
  }
  return output;
}

}  // namespace zrobench::blind
