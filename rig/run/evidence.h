#pragma once
// What the checks look at: one pass over record.ulg, the truth, reduced to seconds, intervals,
// decisions and tables. Nothing here comes from the controller's memory, so a run can be judged
// again later from its folder alone.
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "rig/record/decision.h"
#include "rig/record/item.h"

namespace zrobench {

/// Begins every alarm that says: inputs of the corrector are missing from the record.
inline constexpr std::string_view kInputsLost = "inputs lost: ";
/// Begins every alarm that says: the date of this host went back, and with it that of new entries.
inline constexpr std::string_view kDateBackwards = "wall time goes backwards: ";

struct Interval {
  std::uint64_t first_us = 0, last_us = 0;
  std::string kind;  ///< "tone", "move hand_held", "off"
  /// Whether a profile's word for it ("tone", "move", "hand_held") means this one.
  bool Is(const std::string& word) const {
    return kind == word || kind.starts_with(word + ' ') || kind.ends_with(' ' + word);
  }
  bool Overlaps(std::uint64_t from_us, std::uint64_t to_us) const {
    return from_us < last_us && to_us > first_us;
  }
};

/// A second of means; `quiet` when the board was powered and no stimulus was open nor just over.
struct Second {
  MeanItem mean;
  bool quiet = false;
};

/// The supply was cut. `clean`: DUT_STATUS, when last seen, said that nothing waited to be stored.
struct PowerCut {
  std::uint64_t at_us = 0;
  bool clean = true;
};

/// A decision of the board with the host time at which it was taken.
struct TimedDecision {
  std::uint64_t at_us = 0;
  Decision record;
};

struct Evidence {
  std::vector<Second> seconds;
  std::vector<Interval> stimuli;
  std::vector<TimedDecision> decisions;  ///< in the order read, every boot's
  std::vector<TableItem> tables;
  std::uint64_t samples = 0;
  std::uint64_t samples_lost = 0;    ///< by the sequence byte
  std::uint64_t inputs_lost = 0;     ///< alarms that say so (kInputsLost)
  std::uint64_t decisions_lost = 0;  ///< missing sequence numbers and damaged records in its log
  std::uint64_t first_us = 0, last_us = 0;
  std::vector<std::string> alarms;
  std::vector<PowerCut> cuts;
  std::uint64_t time_back_us = 0;            ///< first sample older than the one before; 0 = none
  bool date_back = false;                    ///< wall time went backwards during the run
  std::vector<std::uint64_t> date_jumps_us;  ///< the rig moved the date by more than a day
  std::uint16_t today_days = 0;  ///< since 1984-01-01, as the rig last told the board; 0 = never
  bool completed = false;        ///< the record holds its end, and the run its whole profile
};

/// The seconds between the moves of the date around `at_us`: a part that has aged in between has
/// another true offset.
std::span<const Second> SameAge(const Evidence& evidence, std::uint64_t at_us);

/// kFile when the record cannot be read. A record cut short is read as far as it goes.
Result<Evidence> GatherEvidence(const std::filesystem::path& record);

}  // namespace zrobench
