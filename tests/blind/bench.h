#pragma once
// One drawn bench: what the station file says of it and what it is.
#include <array>
#include <cstdint>

#include "tests/blind/draw.h"

namespace zrobench::blind {

using Axes = std::array<double, 3>;

/// The quantities of the base model; a nominal set is written to the station file, a scattered one
/// is simulated.
struct BaseModel {
  double ambient_degc = 23;
  double plate_j_per_k = 240;
  double heater_w = 100;
  double cooler_w = 60;
  double plate_to_ambient_w_per_k = 0.30;
  double board_j_per_k = 6;
  double board_to_plate_w_per_k = 0.8;
  double board_to_ambient_w_per_k = 0.01;
  double package_s = 4;
  std::array<std::array<double, 4>, 3> zro_dps{};  ///< cubic in T - 25, per axis
  Axes resonance_hz{33000, 30000, 27000};
  double resonance_q = 450;
  Axes rectification_dps_per_pa2{};  ///< zero where the station does not know it
};

/// Reference of the cubic [degC].
inline constexpr double kReferenceDegc = 25;

/// Noise, registers and habits of one bench.
struct Instruments {
  double gyro_density_dps_per_rthz = 0.005;  ///< one-sided
  double flicker_dps = 0.001;                ///< B in S(f) = B^2 / (2 pi f), one-sided
  double accel_density_g_per_rthz = 1e-4;
  double plate_noise_k = 0.06;    ///< of one poll
  double plate_step_k = 0.1;      ///< register
  double die_noise_k = 0.03;      ///< of one reading
  double die_step_k = 1.0 / 256;  ///< register
  double draft_k = 0.1;           ///< rms of the ambient's Ornstein-Uhlenbeck part
  double draft_s = 120;
  double power_on_dps = 0.01;  ///< rms of the constant new at each power-on
  double controller_pct_per_k = 25;
  double controller_pct_per_k_s = 0.15;
  double controller_slew_pct_per_s = 20;
  int controller_period_s = 1;
};

/// How finely the simulated solids are cut, and losses that every real bench has.
struct Solids {
  int plate_nodes = 18;
  int board_nodes = 8;
  double plate_conductance_w_per_k = 6000;  ///< face to face
  double board_conductance_w_per_k = 150;
  double convection_w = 0;  ///< plate's extra loss at 40 K above ambient, as dT |dT|^(1/4)
  double radiation_m2 = 0;  ///< emissivity times area of the plate
};

struct Bench {
  BaseModel nominal;
  BaseModel actual;
  Instruments instruments;
  Solids solids;
  bool knows_rectification = false;
};

/// Every choice is independent of what will be hidden, except `knows_rectification`, which some
/// effects presuppose.
Bench DrawBench(Draw draw, bool knows_rectification);
/// The same quantities as one lump a solid: the base model itself.
Solids Lumps();

}  // namespace zrobench::blind
