// Table::At: the offset at any temperature, from the stored pairs around it (fig. 5, 56).
#include "corrector/arithmetic.h"
#include "corrector/table.h"

namespace zro {
namespace {

// What a consumer gyro's offset may do between known points. Typical TCO curves are cubics with
// slopes to 0.05 dps/degC, second-order terms to 1e-3 dps/degC^2 and third-order to 1e-5.
constexpr float kSlopeDpsPerDegc = 0.05f;
constexpr float kCurvatureDpsPerDegc2 = 1e-3f;
constexpr float kThirdOrderDpsPerDegc3 = 1e-5f;
constexpr float kMaxCurvatureDpsPerDegc2 = 2.5e-3f;  // more is noise of the entries
constexpr float kHeldSlopeDpsPerDegc = 0.02f;        // growth of the bound where the value is held

/// The entries a curve is laid through: one (held), two (line) or three (parabola).
struct Nodes {
  const Entry* at[3];
  int count = 0;
  void Add(const Entry* entry) { at[count++] = entry; }
};

/// Indices of the entries that take part, in order of temperature.
struct Active {
  const Entry* at[Table::kCapacity];
  int count = 0;
};

float Gap(const Entry* a, const Entry* b) { return fabsf(a->temp_degc - b->temp_degc); }

/// First entry from `from` in direction `step` at least `span` away from `origin`; null: none.
const Entry* FirstBeyond(const Active& active, int from, int step, const Entry* origin,
                         float span) {
  for (int i = from; i >= 0 && i < active.count; i += step) {
    if (Gap(active.at[i], origin) >= span) return active.at[i];
  }
  return nullptr;
}

/// Between two entries. Across a wide gap a third one gives the curvature; it must be about as far
/// away as the gap is wide, or its noise would be magnified.
Nodes Between(const Active& active, int right, float temp_degc, float bin_degc) {
  const Entry* low = active.at[right - 1];
  const Entry* high = active.at[right];
  Nodes nodes;
  nodes.Add(low);
  nodes.Add(high);
  const float gap = Gap(low, high);
  if (gap <= 1.5f * bin_degc) return nodes;
  const float span = Max(bin_degc, 0.5f * gap);
  const Entry* below = FirstBeyond(active, right - 2, -1, low, span);
  const Entry* above = FirstBeyond(active, right + 1, 1, high, span);
  const bool take_below =
      below != nullptr &&
      (above == nullptr || temp_degc - below->temp_degc < above->temp_degc - temp_degc);
  const Entry* third = take_below ? below : above;
  if (third != nullptr) nodes.Add(third);
  return nodes;
}

/// Beyond the outermost entry. The others are taken as far inside as the estimate lies outside, so
/// that entry noise is not magnified more than a few times.
Nodes Beyond(const Active& active, bool below, float distance_degc, float bin_degc) {
  const int step = below ? 1 : -1;
  const int outermost = below ? 0 : active.count - 1;
  const Entry* innermost = active.at[below ? active.count - 1 : 0];
  Nodes nodes;
  nodes.Add(active.at[outermost]);
  const float span = Max(bin_degc, distance_degc);
  const Entry* second = FirstBeyond(active, outermost + step, step, nodes.at[0], span);
  if (second == nullptr && Gap(innermost, nodes.at[0]) >= 0.5f * bin_degc) second = innermost;
  if (second == nullptr) return nodes;
  nodes.Add(second);
  const float reach = Gap(second, nodes.at[0]);
  const Entry* third = FirstBeyond(active, outermost + step, step, nodes.at[0], reach + span);
  if (third == nullptr && Gap(innermost, second) >= Max(bin_degc, 0.5f * span)) third = innermost;
  if (third != nullptr) nodes.Add(third);
  return nodes;
}

float ValueAt(const Nodes& n, int axis, float t) {
  const Entry& a = *n.at[0];
  if (n.count == 1) return a.zro_dps[axis];
  const Entry& b = *n.at[1];
  const float slope = (b.zro_dps[axis] - a.zro_dps[axis]) / (b.temp_degc - a.temp_degc);
  const float line = a.zro_dps[axis] + slope * (t - a.temp_degc);
  if (n.count == 2) return line;
  const Entry& c = *n.at[2];
  const float slope_bc = (c.zro_dps[axis] - b.zro_dps[axis]) / (c.temp_degc - b.temp_degc);
  const float curvature = Clamp((slope_bc - slope) / (c.temp_degc - a.temp_degc),
                                -kMaxCurvatureDpsPerDegc2, kMaxCurvatureDpsPerDegc2);
  return line + curvature * (t - a.temp_degc) * (t - b.temp_degc);
}

/// 1 sigma at t of the polynomial through nodes with independent errors (Lagrange's weights).
float NoiseAt(const Nodes& n, float t) {
  float variance = 0.0f;
  for (int i = 0; i < n.count; ++i) {
    float weight = 1.0f;
    for (int j = 0; j < n.count; ++j) {
      if (j == i) continue;
      weight *= (t - n.at[j]->temp_degc) / (n.at[i]->temp_degc - n.at[j]->temp_degc);
    }
    variance += Square(weight * n.at[i]->sigma_dps);
  }
  return sqrtf(variance);
}

/// Bound on the remainder of the interpolation: the next order's coefficient times the node
/// product.
float ModelAt(const Nodes& n, float t) {
  constexpr float kCoefficient[] = {kSlopeDpsPerDegc, kCurvatureDpsPerDegc2,
                                    kThirdOrderDpsPerDegc3};
  float product = kCoefficient[n.count - 1];
  for (int i = 0; i < n.count; ++i) product *= fabsf(t - n.at[i]->temp_degc);
  return product;
}

}  // namespace

Estimate Table::At(float temp_degc, int without) const {
  Estimate all = Curve(temp_degc, without, true);
  const Estimate learned = Curve(temp_degc, without, false);
  if (!learned.valid || all.learned_only) return all;
  const float share = Square(all.sigma_dps) / (Square(all.sigma_dps) + Square(learned.sigma_dps));
  for (int axis = 0; axis < kAxes; ++axis) {
    all.zro_dps[axis] += share * (learned.zro_dps[axis] - all.zro_dps[axis]);
  }
  all.noise_dps += share * (learned.noise_dps - all.noise_dps);
  all.model_dps += share * (learned.model_dps - all.model_dps);
  all.sigma_dps = sqrtf(Square(all.noise_dps) + Square(0.5f * all.model_dps));
  return all;
}

Estimate Table::Curve(float temp_degc, int without, bool factory) const {
  Estimate estimate{};
  Active active;
  int right = 0;  // first active entry not below temp_degc
  float nearest_degc = 0.0f;
  for (int i = 0; i < size_; ++i) {
    if (!IsActive(i, without) || (!factory && entries_[i].origin == Origin::kFactory)) continue;
    const float distance = fabsf(entries_[i].temp_degc - temp_degc);
    if (active.count == 0 || distance < nearest_degc) nearest_degc = distance;
    if (entries_[i].temp_degc < temp_degc) right = active.count + 1;
    active.at[active.count++] = &entries_[i];
  }
  if (active.count == 0) return estimate;
  const bool below = right == 0;
  const bool outside = below || right == active.count;
  estimate.distance_degc = nearest_degc;
  const float reach = Min(estimate.distance_degc, kMaxExtrapolationDegc);
  const Nodes nodes = outside ? Beyond(active, below, reach, bin_degc_)
                              : Between(active, right, temp_degc, bin_degc_);
  const float t = outside ? nodes.at[0]->temp_degc + (below ? -reach : reach) : temp_degc;
  for (int axis = 0; axis < kAxes; ++axis) estimate.zro_dps[axis] = ValueAt(nodes, axis, t);
  estimate.noise_dps = NoiseAt(nodes, t);
  estimate.model_dps = ModelAt(nodes, t);
  if (outside) estimate.model_dps += kHeldSlopeDpsPerDegc * (estimate.distance_degc - reach);
  estimate.sigma_dps = sqrtf(Square(estimate.noise_dps) + Square(0.5f * estimate.model_dps));
  estimate.extrapolated = outside && estimate.distance_degc > 0.0f;
  estimate.valid = true;
  estimate.learned_only = true;
  for (int i = 0; i < nodes.count; ++i) {
    estimate.learned_only = estimate.learned_only && nodes.at[i]->origin == Origin::kLearned;
  }
  return estimate;
}

}  // namespace zro
