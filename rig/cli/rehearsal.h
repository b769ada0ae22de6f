#pragma once
// A dry run with content: the profile on the virtual rig made of the station's own nominal model,
// whatever instruments the station names. Nothing real moves.
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "rig/profile/profile.h"

namespace zrobench {

struct PlannedStimulus {
  std::string text;
  double start_s = 0, lasts_s = 0;
  double board_degc = 0;                ///< when it begins
  std::map<std::string, int> refusals;  ///< by code name, while it acts and just after
};

struct PlannedStep {
  std::string text;
  double start_s = 0, lasts_s = 0;
  double from_degc = 0, to_degc = 0;  ///< board
  std::vector<PlannedStimulus> stimuli;
};

struct Rehearsal {
  double duration_s = 0;
  std::vector<PlannedStep> steps;
  std::vector<double> entries_degc;  ///< learned, at the end
  std::string halted;                ///< why it would end early; empty when it would not
};

/// Blocks for seconds of real time. kFile when there is no room for its temporary record.
Result<Rehearsal> Rehearse(const Profile& profile, const Station& station);

}  // namespace zrobench
