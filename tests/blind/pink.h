#pragma once
#include <Eigen/Core>

#include "tests/blind/draw.h"

namespace zrobench::blind {

/// Noise with one-sided density flicker^2 / (2 pi f), by spectral synthesis over twice the wanted
/// length, rows 1 s apart; no constant part. Same unit as `flicker`.
Eigen::VectorXd PinkNoise(Draw& draw, int rows, double flicker);

}  // namespace zrobench::blind
