#include "tests/blind/case_set.h"

#include <algorithm>
#include <stdexcept>

namespace zrobench::blind {
namespace {

// How many of each class; `singles_each` times every known effect at every strength.
struct Counts {
  int null, null_flicker, null_drafts, single, singles_each, pair, decoy, parameter_only, foreign,
      not_excited;
};

constexpr Counts kSmoke = {3, 2, 2, 9, 0, 2, 2, 1, 2, 1};
constexpr Counts kFull = {100, 50, 50, 0, 2, 70, 44, 40, 56, 20};
constexpr double kStrengths[] = {10, 20, 40, 100, 400};

// Effects that are easily taken for another.
constexpr std::string_view kDecoys[] = {
    "thermal.ambient_drift", "thermal.dead_time",  "thermal.plate_sensor_lag", "time.latency",
    "time.clock_skew",       "thermal.convection", "thermal.radiation",        "gyro.ageing",
    "gyro.warm_up",          "gyro.creep",         "thermal.die_sensor_hold"};

std::string Any(const std::vector<Kind>& kinds, Draw& draw) {
  return std::string(
      kinds[static_cast<std::size_t>(draw.Below(static_cast<int>(kinds.size())))].id);
}

// One station cannot both know rectification and have it hidden.
bool Compatible(std::string_view a, std::string_view b) {
  return a != b && !(NeedsRectification(a) && ExcludesRectification(b)) &&
         !(NeedsRectification(b) && ExcludesRectification(a));
}

CaseOrder Order(std::string kind, std::vector<std::pair<std::string, double>> hide) {
  CaseOrder order;
  order.kind = std::move(kind);
  order.hide = std::move(hide);
  return order;
}

CaseOrder Pair(Draw& draw) {
  const std::string first = Any(KnownKinds(), draw);
  std::string second = Any(KnownKinds(), draw);
  while (!Compatible(first, second)) second = Any(KnownKinds(), draw);
  return Order("pair", {{first, draw.LogUniform(60, 200)}, {second, draw.LogUniform(60, 200)}});
}

void AddNulls(const Counts& counts, std::vector<CaseOrder>& orders) {
  orders.insert(orders.end(), static_cast<std::size_t>(counts.null), Order("null", {}));
  CaseOrder flicker = Order("null_flicker", {});
  flicker.flicker_factor = 1.5;
  orders.insert(orders.end(), static_cast<std::size_t>(counts.null_flicker), flicker);
  CaseOrder drafts = Order("null_drafts", {});
  drafts.draft_factor = 2;
  orders.insert(orders.end(), static_cast<std::size_t>(counts.null_drafts), drafts);
  CaseOrder parameters = Order("parameter_only", {});
  parameters.foreign_nominals = true;
  orders.insert(orders.end(), static_cast<std::size_t>(counts.parameter_only), parameters);
}

void AddSingles(const Counts& counts, Draw& draw, std::vector<CaseOrder>& orders) {
  for (int i = 0; i < counts.single; ++i) {
    orders.push_back(Order("single", {{Any(KnownKinds(), draw), kStrengths[i % 5]}}));
  }
  for (int i = 0; i < counts.singles_each; ++i) {
    for (const Kind& kind : KnownKinds()) {
      for (const double lambda : kStrengths) {
        orders.push_back(Order("single", {{std::string(kind.id), lambda}}));
      }
    }
  }
}

}  // namespace

std::vector<CaseOrder> OrdersOf(std::string_view set, std::uint64_t seed) {
  if (set != "smoke" && set != "full") {
    throw std::invalid_argument("there is no set '" + std::string(set) + "' (known: smoke, full)");
  }
  const Counts& counts = set == "full" ? kFull : kSmoke;
  Draw draw(seed, "orders");
  std::vector<CaseOrder> orders;
  AddNulls(counts, orders);
  AddSingles(counts, draw, orders);
  for (int i = 0; i < counts.pair; ++i) orders.push_back(Pair(draw));
  for (int i = 0; i < counts.decoy; ++i) {
    orders.push_back(Order("decoy", {{std::string(kDecoys[(i * 7) % 11]), 60}}));
  }
  for (int i = 0; i < counts.foreign; ++i) {
    const auto kind = static_cast<std::size_t>(i) % ForeignKinds().size();
    const std::string id(
        ForeignKinds()[set == "full" ? kind
                                     : static_cast<std::size_t>(
                                           draw.Below(static_cast<int>(ForeignKinds().size())))]
            .id);
    orders.push_back(Order("foreign", {{id, draw.LogUniform(100, 400)}}));
  }
  for (int i = 0; i < counts.not_excited; ++i) {
    orders.push_back(Order("not_excited", {{Any(KnownKinds(), draw), 0.5}}));
  }
  for (std::size_t i = orders.size() - 1; i > 0; --i) {
    std::swap(orders[i], orders[static_cast<std::size_t>(draw.Below(static_cast<int>(i) + 1))]);
  }
  return orders;
}

}  // namespace zrobench::blind
