#pragma once
// What can be hidden, by id. An effect is a strength times a direction over the gyro's axes, and
// shape parameters; what an id does is told once each in thermal.cc, gyro.cc and sampling.cc.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/blind/bench.h"

namespace zrobench::blind {

struct Effect {
  std::string id;
  double strength = 0;        ///< in Kind::unit
  Axes axes{1, 1, 1};         ///< share of each gyro axis; unused by thermal effects
  std::vector<double> shape;  ///< as Kind::shapes
};

/// Which part of a bench an effect lives in: what must be simulated anew when it changes.
enum class Stage { kThermal, kSampling, kGyro };

struct ShapeRange {
  std::string_view name;  ///< ends in its unit
  double low, high;       ///< drawn log-uniformly when low > 0
};

struct Kind {
  std::string_view id;
  Stage stage;
  std::string_view strength_name;  ///< ends in its unit
  std::string_view unit;
  double typical;  ///< a strength that is neither zero nor absurd
  double most;     ///< beyond it the effect would be a broken bench
  std::vector<ShapeRange> shapes;
  std::vector<std::vector<double>> grid;  ///< shapes tried when it is suspected as a look-alike
  bool signed_strength = false;           ///< drawn with either sign
  bool grid_is_joint = false;             ///< the grid's entries act at once, not instead
};

/// Effects with an id in the catalogue of known physics.
const std::vector<Kind>& KnownKinds();
/// Physics that no catalogue holds: the right answer is that it is unexplained.
const std::vector<Kind>& ForeignKinds();
/// Throws std::out_of_range for an unknown id.
const Kind& KindOf(std::string_view id);
bool IsKnown(std::string_view id);
/// Whether the effect presupposes (true) or excludes (false) that the station knows rectification.
bool NeedsRectification(std::string_view id);
bool ExcludesRectification(std::string_view id);
/// Whether each gyro axis has a share of its own; otherwise one figure tells all.
bool ActsOnEachAxis(const Kind& kind);
/// Shapes tried when it is suspected: the grid, or the one shape without parameters.
std::vector<std::vector<double>> SuspectedShapes(const Kind& kind);

/// Shape and axes drawn, strength typical.
Effect DrawEffect(const Kind& kind, Draw& draw);

/// The effect called `id` in `effects`, or null.
const Effect* Find(const std::vector<Effect>& effects, std::string_view id);
/// Its strength, 0 when absent.
double StrengthOf(const std::vector<Effect>& effects, std::string_view id);
/// Its first shape parameter, `otherwise` when absent.
double ShapeOf(const std::vector<Effect>& effects, std::string_view id, double otherwise);

}  // namespace zrobench::blind
