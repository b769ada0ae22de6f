#pragma once
// How a term describes its parameters and its channels, without repeating what most have alike.
#include <string_view>
#include <vector>

#include "rig/physics/term.h"

namespace zrobench::physics {

/// A coefficient with a value for each axis of the gyro.
inline ParameterInfo PerAxis(std::string_view name, std::string_view unit, double typical,
                             std::string_view sign) {
  return {name, unit, std::vector<double>(3, typical), typical, true, false, sign};
}
/// A coefficient of one value.
inline ParameterInfo Single(std::string_view name, std::string_view unit, double typical,
                            std::string_view sign) {
  return {name, unit, {typical}, typical, true, false, sign};
}
/// A coefficient that has a meaning from zero upwards only. `grid`: see ParameterInfo.
inline ParameterInfo Amount(std::string_view name, std::string_view unit, double typical,
                            std::string_view sign, std::vector<double> grid = {}) {
  return {name, unit, {typical}, typical, true, false, sign, std::move(grid), true};
}
/// A time constant, a width: a shape parameter that must be > 0.
inline ParameterInfo Width(std::string_view name, std::string_view unit, double typical,
                           std::string_view sign, std::vector<double> grid) {
  return {name, unit, {typical}, typical, false, true, sign, std::move(grid)};
}
/// A temperature: a shape parameter of either sign.
inline ParameterInfo Location(std::string_view name, std::string_view unit, double typical,
                              std::string_view sign, std::vector<double> grid) {
  return {name, unit, {typical}, typical, false, false, sign, std::move(grid)};
}

inline std::vector<std::string_view> GyroChannels() {
  return {"gyro_x_dps", "gyro_y_dps", "gyro_z_dps"};
}
/// What the heat of the board reaches.
inline std::vector<std::string_view> BoardChannels() {
  return {"imu_degc", "gyro_x_dps", "gyro_y_dps", "gyro_z_dps"};
}
/// What the heat of the plate reaches.
inline std::vector<std::string_view> AllChannels() {
  return {"plate_degc", "imu_degc", "gyro_x_dps", "gyro_y_dps", "gyro_z_dps"};
}

}  // namespace zrobench::physics
