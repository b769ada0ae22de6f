#pragma once
// A station: which instruments, their limits, and the nominal model (TOML, docs/formats.md).
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "rig/physics/model.h"

namespace zrobench {

struct StationLimits {
  double min_degc = -20, max_degc = 70;  ///< set points
  double max_rate_degc_per_min = 10;
  double max_tone_v = 10;
  double min_tone_hz = 20, max_tone_hz = 40000;
  double max_spl_db = 120;
  double max_tone_s = 600;  ///< one tone without a pause
};

struct VirtualSettings {
  UtcNs epoch = 1'767'225'600'000'000'000;  ///< 2026-01-01T00:00:00Z
  double sample_hz = 200;
  double gyro_range_dps = 250;  ///< 125 * 2^c
  double kp_pct_per_k = 40, ki_pct_per_k_s = 0.8;
  double rate_limit_degc_per_min = 0;               ///< of the plate's own controller; 0 = none
  std::vector<double> factory_degc = {10, 25, 40};  ///< temperatures of the factory's entries
  double factory_error_dps = 0.005;                 ///< rms error of those entries
};

/// What the instruments' certificates say; kept with every run.
struct StationCalibration {
  std::string certificate;               ///< number or file, free text
  double plate_uncertainty_k2_degc = 0;  ///< expanded, k = 2 (GUM); 0 = not stated
  double speaker_uncertainty_k2_db = 0;
};

/// What a foreign logger's recordings mean, for `diagnose`.
struct RecordingSettings {
  bool mean_rows = true;                    ///< measured columns are means since the row before
  bool starts_at_power_on = true;           ///< else how long the board had been on is not known
  std::map<std::string, double> started_h;  ///< run -> hours since the first run's start
  std::string map;  ///< import map for every run-*.csv; empty = canonical columns
};

struct Station {
  std::string name;
  std::string text;  ///< the file as read, for the run folder
  std::filesystem::path path;
  std::string plate = "virtual:", speaker = "virtual:", board = "virtual:";
  /// Empty: no such instrument (power: the operator is asked; environment: constants below).
  std::string power = "virtual:", environment;
  bool purge = false;        ///< dry gas: may go below the dew point
  double humidity_pct = 40;  ///< where there is no sensor
  StationLimits limits;
  StationCalibration calibration;
  double clock_speed = 1;  ///< of `serve`: virtual seconds a second
  VirtualSettings virtual_rig;
  RecordingSettings recording;
  physics::Model model;

  /// The in-process rig serves every role that this station has.
  bool all_virtual() const {
    const auto served = [](const std::string& address) {
      return address.empty() || address == "virtual:";
    };
    return plate == "virtual:" && board == "virtual:" && served(speaker) && served(power) &&
           served(environment);
  }
};

/// Reads and validates. On failure the message holds every error, one `file:line:column: error:
/// ...` a line (kConfig), or says why the file could not be read (kFile).
Result<Station> LoadStation(const std::filesystem::path& path);

}  // namespace zrobench
