#pragma once
// The parameters of the physical model, as a station file's [model] names them (design: base
// equations beside each). Plain data; nominal values, within some 30 % of the truth.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace zrobench::physics {

using Axes = std::array<double, 3>;

/// C_p T_p' = Q(drive) - G_pa (T_p - T_a) - G_pb (T_p - T_b); the plate sensor reads T_p.
struct PlateModel {
  double heat_capacity_j_per_k = 240.0;
  double heater_w = 100.0;
  double cooler_w = 60.0;
  double to_ambient_w_per_k = 0.30;
  double resolution_degc = 0.1;
};
/// C_b T_b' = G_pb (T_p - T_b) - G_ba (T_b - T_a)
struct BoardModel {
  double heat_capacity_j_per_k = 6.0;
  double to_plate_w_per_k = 0.8;
  double to_ambient_w_per_k = 0.01;
};
/// tau_d T_d' = T_b - T_d; the IMU's sensor reads T_d.
struct PackageModel {
  double time_constant_s = 4.0;
  double resolution_degc = 0.00390625;
};
/// rate = cubic(T_d - reference) + white + flicker, S(f) = B^2 / (2 pi f).
struct GyroModel {
  double reference_degc = 25.0;
  double noise_density_dps_per_rthz = 0.005;  ///< one-sided
  double flicker_dps = 0.001;                 ///< B
  std::array<std::array<double, 4>, 3> zro_dps = {
      {{0.8, 0.030, -4e-4, 1e-5}, {-1.1, -0.022, 5e-4, 0.0}, {0.35, 0.012, 2e-4, -6e-6}}};
};
struct AccelModel {
  double noise_density_g_per_rthz = 1e-4;
};
struct SpeakerModel {
  double pa_per_v = 1.0;  ///< at the package
};

/// Parameters of one term: name -> one value per axis or a single one.
using TermParameters = std::map<std::string, std::vector<double>>;

struct Model {
  double ambient_degc = 23.0;
  PlateModel plate;
  std::optional<BoardModel> board = BoardModel{};
  std::optional<PackageModel> package = PackageModel{};
  std::optional<GyroModel> gyro = GyroModel{};
  AccelModel accel;
  SpeakerModel speaker;
  std::vector<std::string> terms;              ///< ids, in order of application
  std::map<std::string, TermParameters> term;  ///< only what the file states; else defaults
};

/// One thing wrong with a model.
struct ModelError {
  std::string key;      ///< as in a station file: model.plate.heat_capacity_j_per_k
  std::string message;  ///< starts with the key: "<key> must be > 0, is -3"
};
/// Everything that makes the model impossible: non-positive capacity, unknown term or parameter,
/// wrong length. Empty = valid.
std::vector<ModelError> FindErrors(const Model& model);
/// The same as one kConfig error, a message a line.
Status Validate(const Model& model);

}  // namespace zrobench::physics
