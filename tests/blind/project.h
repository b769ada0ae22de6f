#pragma once
// What is left of an effect once every quantity of the base model may compensate for it.
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tests/blind/respond.h"
#include "tests/blind/whiten.h"

namespace zrobench::blind {

/// An orthonormal basis of some columns' span; dependent columns fall away.
class Span {
 public:
  explicit Span(const Eigen::MatrixXd& columns);
  Eigen::MatrixXd Remainder(const Eigen::MatrixXd& columns) const;

 private:
  Eigen::MatrixXd basis_;
};

/// Columns of an effect's SuspectedShapes, in the groups that are each tried as an explanation.
std::vector<Eigen::MatrixXd> Alternatives(const Kind& kind, const Eigen::MatrixXd& columns);

/// The base model of one bench about its recording: noise, nuisances, and look-alikes.
class Yardstick {
 public:
  /// `model` is where derivatives are taken; one lump a solid.
  Yardstick(const Bench& bench, Campaign campaign);

  /// Whitened and projected off every nuisance: the quantities of the station's [model], a
  /// constant per axis and power-on, temperatures at power-on. `stacked` as from Stack.
  Eigen::MatrixXd Project(const Eigen::MatrixXd& stacked) const;
  /// Squared length of Project: the noncentrality of a test that knows what to look for.
  double Lambda(const Eigen::VectorXd& stacked) const { return Project(stacked).squaredNorm(); }
  /// The same after fitting the base model to a noiseless recording (Gauss-Newton): what no choice
  /// of its quantities can explain.
  double LambdaOfMisfit(const Eigen::VectorXd& recording) const;
  /// One Gauss-Newton step of the quantities from `from`, whose whitened misfit is given.
  BaseModel Step(const BaseModel& from, const Eigen::VectorXd& misfit) const;
  /// Recording minus simulation, whitened.
  Eigen::VectorXd Misfit(const BaseModel& model, const Eigen::VectorXd& recording) const;

  struct Alike {
    std::string id;
    double noncentrality = 0;  ///< of the truth once this one is allowed to explain it
  };
  /// The known effect, beside `except`, that leaves least of a projected effect.
  Alike NearestAlike(const Eigen::VectorXd& projected,
                     const std::vector<std::string>& except) const;
  /// Projected columns of an effect, shape by shape: three, an axis each, where it acts on the
  /// gyro.
  Eigen::MatrixXd ColumnsOf(const Kind& kind,
                            const std::vector<std::vector<double>>& shapes) const {
    return Project(Signatures(kind, shapes));
  }
  /// The same as stacked signals, neither whitened nor projected.
  Eigen::MatrixXd Signatures(const Kind& kind,
                             const std::vector<std::vector<double>>& shapes) const;

  /// Whether this bench could have the effect hidden at all.
  bool MaySuspect(const Kind& kind) const;
  /// The base model's own recording at the point of linearisation.
  const Eigen::VectorXd& reference() const { return reference_; }
  const Campaign& campaign() const { return campaign_; }

 private:
  struct Nuisance {
    std::function<double&(BaseModel&)> value;
    double step;
    bool heat;          ///< heat flow must be simulated anew
    double most_share;  ///< of its value, in one step
  };
  std::vector<Nuisance> Nuisances() const;
  Eigen::MatrixXd Jacobian() const;
  Eigen::MatrixXd Constants() const;
  Eigen::VectorXd About(const BaseModel& model, const Paths& paths) const;

  bool acoustic_;
  BaseModel nominal_, model_;
  Campaign campaign_;
  Paths paths_;
  Eigen::VectorXd reference_;
  Whitener whitener_;
  Eigen::MatrixXd whitened_jacobian_;
  Span nuisances_;
};

}  // namespace zrobench::blind
