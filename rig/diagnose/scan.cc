#include "rig/diagnose/scan.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "rig/diagnose/chi_square.h"
#include "rig/diagnose/columns.h"
#include "rig/physics/random.h"

namespace zrobench::diagnose {
namespace {

constexpr double kSilent = 1e-6;    ///< squared length of a column that shows nothing
constexpr double kAbsorbed = 1e-5;  ///< share of a column's squared length that must survive
constexpr double kVisible = 5;      ///< sigma
constexpr int kDraws = 4000;

/// Directions of a small information matrix that hold information.
struct Inverse {
  Eigen::MatrixXd pseudo;
  double rank;
};
Inverse Invert(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double least = values.maxCoeff() * 1e-9;
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(values.size());
  double rank = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i] <= least) continue;
    inverse[i] = 1 / values[i];
    ++rank;
  }
  return {eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose(), rank};
}

}  // namespace

Scan::Scan(const Problem& problem, const Filters& filters, const Fitted& about,
           const std::vector<Effect>& candidates) {
  std::vector<Eigen::VectorXd> columns;
  for (const Effect& effect : candidates) {
    Block block{effect, static_cast<Eigen::Index>(columns.size()), 0, {}};
    std::vector<Eigen::VectorXd> own = ColumnsOf(effect, problem, filters, about);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (own[k].squaredNorm() <= kSilent || !own[k].allFinite()) continue;
      columns.push_back(std::move(own[k]));
      block.coefficients.push_back(k);
      ++block.count;
    }
    if (block.count > 0) blocks_.push_back(std::move(block));
  }
  Eigen::MatrixXd c(problem.rows(), static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index k = 0; k < c.cols(); ++k) c.col(k) = columns[static_cast<std::size_t>(k)];
  const Eigen::MatrixXd cross = about.columns.transpose() * c;
  information_ = c.transpose() * c;
  const Eigen::VectorXd raw = information_.diagonal();
  information_ -= cross.transpose() * about.Information().ldlt().solve(cross);
  // The residual is at its optimum: the fitted columns are orthogonal to it but for the priors.
  const Eigen::VectorXd score = c.transpose() * about.residual;

  std::map<std::string_view, Score> best;
  for (const Block& block : blocks_) {
    const double left = information_.diagonal().segment(block.first, block.count).maxCoeff();
    if (left < kAbsorbed * raw.segment(block.first, block.count).maxCoeff()) continue;
    Score judged = Judge(block, score.segment(block.first, block.count));
    Score& kept = best[block.effect.info->id];
    if (!kept.effect.info || judged.evidence > kept.evidence) kept = std::move(judged);
  }
  for (auto& [id, score_of] : best) scores_.push_back(std::move(score_of));
  std::ranges::sort(scores_, std::greater{}, &Score::evidence);
  for (const Effect& effect : candidates) {
    const bool known = best.contains(effect.info->id);
    if (!known && std::ranges::find(silent_, effect.info) == silent_.end()) {
      silent_.push_back(effect.info);
    }
  }
}

Score Scan::Judge(const Block& block, const Eigen::VectorXd& score) const {
  const Eigen::MatrixXd own =
      information_.block(block.first, block.first, block.count, block.count);
  const Inverse inverse = Invert(own);
  Score judged{block.effect, {}, score.dot(inverse.pseudo * score), 0};
  judged.limit.resize(CoefficientsOf(*block.effect.info).size(),
                      std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < block.coefficients.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    judged.limit[block.coefficients[i]] = kVisible / std::sqrt(std::max(own(k, k), 1e-30));
  }
  judged.evidence = -2 * LogChiSquareTail(judged.gain, inverse.rank);
  return judged;
}

double Scan::Threshold(double alpha, std::uint64_t seed) const {
  if (blocks_.empty()) return 0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information_);
  const Eigen::MatrixXd root =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  std::vector<Inverse> inverses;
  for (const Block& b : blocks_) {
    inverses.push_back(Invert(information_.block(b.first, b.first, b.count, b.count)));
  }
  physics::RandomStream random(seed, 0);
  Eigen::VectorXd draw(information_.cols());
  std::vector<double> largest(kDraws);
  for (double& most : largest) {
    for (double& d : draw) d = random.Normal();
    const Eigen::VectorXd score = root * draw;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const auto mine = score.segment(blocks_[i].first, blocks_[i].count);
      const double gain = mine.dot(inverses[i].pseudo * mine);
      most = std::max(most, -2 * LogChiSquareTail(gain, inverses[i].rank));
    }
  }
  const auto at = largest.begin() + static_cast<std::ptrdiff_t>(
                                        std::floor((1 - alpha) * static_cast<double>(kDraws)));
  std::nth_element(largest.begin(), at, largest.end());
  return *at;
}

}  // namespace zrobench::diagnose
