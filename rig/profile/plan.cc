#include "rig/profile/plan.h"

#include <algorithm>
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
  double operator()(const Music& music) const { return music.for_s; }
  double operator()(const Sweep& sweep) const { return sweep.for_s; }
  double operator()(const Load& load) const { return load.for_s; }
  double operator()(const Move& move) const { return move.for_s; }
  double operator()(const DateStep&) const { return 0; }
  double operator()(const PowerCycle& cycle) const { return cycle.off_s + kBootS; }
};

/// Until the last of them is over; those that wait for a temperature come while the step lasts.
double LastsS(const std::vector<Stimulus>& stimuli) {
  double end_s = 0;
  for (const Stimulus& stimulus : stimuli) {
    const double lasts_s = std::visit([](const auto& what) { return what.for_s; }, stimulus.what);
    end_s = std::max(end_s, stimulus.at_s.value_or(0) + lasts_s);
  }
  return end_s;
}

}  // namespace

double NominalDurationS(const Profile& profile, double start_degc) {
  return StepEndsS(profile, start_degc).back();
}

std::vector<double> StepEndsS(const Profile& profile, double start_degc) {
  Timer timer{start_degc};
  std::vector<double> ends_s = {0};
  for (const Step& step : profile.steps) {
    ends_s.push_back(ends_s.back() + std::max(std::visit(timer, step.action), LastsS(step.with)));
  }
  return ends_s;
}

}  // namespace zrobench
