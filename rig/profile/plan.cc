#include "rig/profile/plan.h"

#include <cmath>

namespace zrobench {
namespace {

// A plate of 240 J/K with 60..100 W moves at about 15..24 degC/min.
constexpr double kSoakRateDegcPerMin = 15;
// Settled means 20 s in the band at least; a set point that is left for another one, also
// by a ramp, takes the plate's controller and the board's own time constants to come to rest.
constexpr double kSettleHereS = 20;
constexpr double kSettleThereS = 50;
constexpr double kBootS = 1;

struct Timer {
  double degc;        // set point reached so far
  bool rests = true;  // the board has been there for a while

  double Travel(double to_degc, double rate_degc_per_min) {
    const double s = std::abs(to_degc - degc) / rate_degc_per_min * 60;
    degc = to_degc;
    return s;
  }
  double operator()(const Soak& soak) {
    const bool at_rest = rests && soak.to_degc == degc;
    rests = true;
    return Travel(soak.to_degc, kSoakRateDegcPerMin) + (at_rest ? kSettleHereS : kSettleThereS) +
           soak.hold_s;
  }
  double operator()(const Ramp& ramp) {
    rests = rests && ramp.to_degc == degc;
    return Travel(ramp.to_degc, ramp.rate_degc_per_min);
  }
  double operator()(const Hold& hold) const { return hold.for_s; }
  double operator()(const Tone& tone) const { return tone.for_s; }
  double operator()(const Move& move) const { return move.for_s; }
  double operator()(const DateStep&) const { return 0; }
  double operator()(const PowerCycle& cycle) const { return cycle.off_s + kBootS; }
};

}  // namespace

double NominalDurationS(const Profile& profile, double start_degc) {
  Timer timer{start_degc};
  double sum_s = 0;
  for (const Step& step : profile.steps) sum_s += std::visit(timer, step.action);
  return sum_s;
}

}  // namespace zrobench
