#pragma once
#include <map>
#include <string>
#include <vector>

#include "rig/diagnose/diagnosis.h"
#include "rig/diagnose/fit.h"

namespace zrobench::diagnose {

/// rms of measured - predicted for each channel, pooled over the runs. Temperatures are simulated
/// open loop from their first value; rates have each power-on's own constant taken off, which
/// differs from one power-on to the next and is nobody's to predict.
PerChannel PredictionErrors(const Problem& problem, const Filters& filters, const Fitted& fit);

/// Every run in turn is predicted by models fitted to the others: once without, once with the
/// effects. Empty with a single run.
struct HeldOut {
  PerChannel before, after;
};
HeldOut HoldOut(const Problem& problem, const Noise& noise, const Fitted& base, const Fitted& best);

}  // namespace zrobench::diagnose
