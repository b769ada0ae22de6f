#pragma once
#include "rig/diagnose/fit.h"
#include "rig/diagnose/problem.h"

namespace zrobench::diagnose {

/// What the station states, and usual sensors where it states nothing.
Noise NominalNoise(const Problem& problem);

/// Restricted maximum likelihood of the noise, each channel by itself: everything that the base
/// model and every one of `suspects` could explain is projected out first, so that an effect left
/// out of the model is not taken for noise. Held to within a factor of a few of `start` by a weak
/// prior, and then raised a little: noise taken too small turns into false names.
Noise EstimateNoise(const Problem& problem, const Fitted& base, const Noise& start,
                    const std::vector<Effect>& suspects);

}  // namespace zrobench::diagnose
