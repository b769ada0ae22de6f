#include "rig/diagnose/columns.h"

namespace zrobench::diagnose {
namespace {

std::vector<Eigen::VectorXd> ThermalColumnsOf(const Effect& effect, const Filters& filters,
                                              const Fitted& about) {
  Point point = about.point;
  Install(effect, point);
  std::vector<Eigen::VectorXd> columns;
  for (const Knob& knob : EffectKnobs(effect)) {
    Point moved = point;
    knob.Move(moved, knob.probe);
    columns.push_back(
        filters.ThermalColumn(about.at, filters.Evaluate(moved), about.slopes_dps_per_k) /
        knob.probe);
  }
  return columns;
}

}  // namespace

std::vector<Eigen::VectorXd> RateColumnsOf(const Effect& effect, const Problem& problem,
                                           const physics::Model& model, const Filters& filters,
                                           const Evaluated& at) {
  std::vector<Eigen::VectorXd> columns;
  for (const RateResponse& response : RateResponses(effect, problem, model, at)) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(problem.rows());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<Eigen::ArrayXd> rates;
      for (const auto& run : response.rates) rates.push_back(run[axis]);
      column += filters.RateColumn(axis, rates);
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<Eigen::VectorXd> ColumnsOf(const Effect& effect, const Problem& problem,
                                       const Filters& filters, const Fitted& about) {
  return IsThermal(*effect.info)
             ? ThermalColumnsOf(effect, filters, about)
             : RateColumnsOf(effect, problem, about.point.model, filters, about.at);
}

}  // namespace zrobench::diagnose
