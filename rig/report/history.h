#pragma once
// A run as its report tells it: one pass over record.ulg, the truth. Times are bench seconds since
// the record began.
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "rig/record/decision.h"
#include "rig/record/snapshot.h"

namespace zrobench {

struct History {
  /// Means over the second that ends at `t_s`; `quiet` when no stimulus was open in it nor in the
  /// two seconds before.
  struct Second {
    double t_s = 0, board_degc = 0;
    std::array<double, 3> raw_dps{}, rate_dps{};
    bool quiet = false;
  };
  /// NaN for the set point until the first step, for the board until it spoke and while it is off.
  struct PlatePoint {
    double t_s = 0, setpoint_degc = 0, plate_degc = 0, board_degc = 0;
  };
  /// "tone", "move hand_held"; "off" while the board's supply is cut.
  struct Stimulus {
    double from_s = 0, to_s = 0;
    std::string kind;
    double hz = 0, spl_db = 0;  ///< of a tone
  };
  /// A decision of the board's log, at the time it was taken.
  struct Reading {
    double t_s = 0;
    Decision decision;
    int stimulus = -1;  ///< that acted, or had ended within RunSnapshot::kStimulusEchoUs; -1 none
    bool expected() const { return stimulus >= 0; }
  };
  /// One sine without a change, or one piece of music, whatever its loudness (spl_db: its loudest);
  /// `decisions`: of the readings that it was the longest part of. `shift_dps`: mean corrected rate
  /// during it minus that of the quiet seconds (at most 10) before it, or before the sweep it is
  /// part of; NaN where either is missing.
  struct Tone {
    double from_s = 0, to_s = 0, hz = 0, spl_db = 0, board_degc = 0;
    std::array<double, 3> shift_dps{};
    double band_hz = 0;  ///< 0 = a sine
    std::map<zro::Code, int> decisions = {};
  };
  /// The board warmed itself.
  struct Load {
    double from_s = 0, to_s = 0, duty_pct = 0;
  };

  struct Alarm {
    double t_s = 0;
    std::string text;
  };

  double duration_s = 0;
  std::uint64_t start_us = 0;  ///< time stamp of the record that is t = 0
  std::vector<Second> seconds;
  std::vector<PlatePoint> plate;
  std::vector<Stimulus> stimuli;
  std::vector<Reading> readings;
  std::vector<Tone> tones;
  std::vector<Load> loads;
  std::vector<Alarm> alarms;  ///< of the rig
  zro::Table table;           ///< the board's, as last read
  double table_s = -1;        ///< when it was read; -1 = never
  std::string damage;         ///< where and why the record ends early; empty when it is whole
};

/// kFile when the record cannot be read; one that is cut short is read as far as it goes. Blocks.
Result<History> ReadHistory(const std::filesystem::path& record);

/// The reading's values went into the table, or confirmed what stands there (codes 32-35, 37).
bool IsAccepted(zro::Code code);

}  // namespace zrobench
