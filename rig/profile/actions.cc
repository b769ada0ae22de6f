#include "rig/profile/actions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "rig/profile/dew_point.h"
#include "rig/profile/limits.h"
#include "rig/profile/sounds.h"

namespace zrobench {
namespace {

constexpr double kMinRate_degc_per_min = 0.01;  // slower is a slip of units, or a month

const std::vector<std::string> kKinds = {"soak",  "ramp", "hold",        "tone", "music",
                                         "sweep", "move", "power_cycle", "load", "date"};
// Named by the format, not driven by this version: refused, so that nothing is left out silently.
const std::vector<std::string> kLater = {"confirm"};
const std::vector<std::string> kMoves = {"tap", "rotate", "vibrate", "hand_held"};

// Wet boards drift and short: below the dew point only with dry gas.
void ReadSetPoint(TableReader* reader, const Station& station, double* degc) {
  if (!reader->Number("to_degc", degc, SetPointRange(station)) || station.purge) return;
  const double ambient_degc = station.model.ambient_degc;
  const double dew_point_degc = DewPoint_degc(ambient_degc, station.humidity_pct);
  if (*degc >= dew_point_degc) return;
  reader->Complain(
      "to_degc", fmt::format("to_degc = {} is below the dew point of {:.1f} degC ({} degC, {} %RH) "
                             "and station {} has no dry gas (purge = true)",
                             *degc, dew_point_degc, ambient_degc, station.humidity_pct,
                             station.path.string()));
}

Soak ReadSoak(TableReader reader, const Station& station) {
  Soak soak;
  ReadSetPoint(&reader, station, &soak.to_degc);
  reader.Number("hold_s", &soak.hold_s, DurationRange());
  reader.Number("settled_degc", &soak.settled_degc, Range::Between(0.01, 10));
  reader.Require({"to_degc", "hold_s"});
  reader.RefuseOtherKeys();
  return soak;
}

Ramp ReadRamp(TableReader reader, const Station& station) {
  Ramp ramp;
  const Range rate = Limited(kMinRate_degc_per_min, station.limits.max_rate_degc_per_min,
                             "slower than any bench", LimitOf(station, "max_rate_degc_per_min"));
  ReadSetPoint(&reader, station, &ramp.to_degc);
  reader.Number("rate_degc_per_min", &ramp.rate_degc_per_min, rate);
  reader.Require({"to_degc", "rate_degc_per_min"});
  reader.RefuseOtherKeys();
  return ramp;
}

Hold ReadHold(TableReader reader) {
  Hold hold;
  reader.Number("for_s", &hold.for_s, DurationRange());
  reader.Require({"for_s"});
  reader.RefuseOtherKeys();
  return hold;
}

Move ReadMove(TableReader reader) {
  Move move;
  reader.Choice("how", &move.how, kMoves);
  reader.Number("for_s", &move.for_s, DurationRange());
  reader.Require({"how", "for_s"});
  reader.RefuseOtherKeys();
  return move;
}

PowerCycle ReadPowerCycle(TableReader reader) {
  PowerCycle cycle;
  reader.Number("off_s", &cycle.off_s, DurationRange());
  reader.Require({"off_s"});
  reader.RefuseOtherKeys();
  return cycle;
}

DateStep ReadDate(TableReader reader, const Station& station) {
  DateStep date;
  std::size_t days = 0;
  if (reader.Count("advance_days", &days, Range::Between(1, 3650))) {
    date.advance_days = static_cast<double>(days);
  }
  reader.Require({"advance_days"});
  reader.RefuseOtherKeys();
  if (!station.all_virtual()) {
    reader.Complain("", fmt::format("only a virtual rig can move the date; station {} is a real "
                                    "bench",
                                    station.path.string()));
  }
  return date;
}

Load ReadLoad(TableReader reader) {
  Load load;
  reader.Number("duty_pct", &load.duty_pct, Range::Between(1, 100));
  reader.Number("for_s", &load.for_s, DurationRange());
  reader.Require({"duty_pct", "for_s"});
  reader.RefuseOtherKeys();
  return load;
}

Action ReadKind(const std::string& kind, const TableReader& table, const Station& station) {
  if (kind == "soak") return ReadSoak(table, station);
  if (kind == "ramp") return ReadRamp(table, station);
  if (kind == "hold") return ReadHold(table);
  if (kind == "tone") return ReadTone(table, station);
  if (kind == "music") return ReadMusic(table, station);
  if (kind == "sweep") return ReadSweep(table, station);
  if (kind == "load") return ReadLoad(table);
  if (kind == "move") return ReadMove(table);
  if (kind == "date") return ReadDate(table, station);
  return ReadPowerCycle(table);
}

// A stimulus that never comes would make a run that proves nothing.
void CheckStart(const Action& action, std::optional<double> from_degc, const Stimulus& stimulus,
                TableReader reader) {
  const std::optional<double> to_degc = SetPointOf(action);
  if (stimulus.at_degc && !to_degc) {
    reader.Complain("at_degc", "only a soak or a ramp passes a temperature; use at_s");
  }
  if (stimulus.at_degc && to_degc && from_degc) {
    const auto [low, high] = std::minmax(*from_degc, *to_degc);
    if (*stimulus.at_degc < low || *stimulus.at_degc > high) {
      reader.Complain("at_degc", fmt::format("at_degc = {} is not passed on the way from {} to {}",
                                             *stimulus.at_degc, *from_degc, *to_degc));
    }
  }
  if (std::holds_alternative<PowerCycle>(action) && std::holds_alternative<Load>(stimulus.what)) {
    reader.Complain("load", "a board without its supply carries no load");
  }
  const Hold* hold = std::get_if<Hold>(&action);
  if (hold && stimulus.at_s && *stimulus.at_s >= hold->for_s) {
    reader.Complain("at_s", fmt::format("at_s = {} is after the hold's end at {} s", *stimulus.at_s,
                                        hold->for_s));
  }
}

using What = decltype(Stimulus::what);

/// The one table of a stimulus that names what it is.
std::optional<What> ReadWhat(TableReader* reader, const Station& station) {
  std::optional<What> what;
  int found = 0;
  for (const std::string kind : {"tone", "music", "sweep", "move", "load"}) {
    const TableReader table = reader->Table(kind);
    if (!table.present()) continue;
    ++found;
    std::visit(
        [&]<typename T>(T action) {
          if constexpr (std::is_constructible_v<What, T>) what = std::move(action);
        },
        ReadKind(kind, table, station));
  }
  return found == 1 ? what : std::nullopt;
}

// Each with its own start: `at_s` or `at_degc`.
std::optional<Stimulus> ReadStimulus(TableReader reader, const Station& station) {
  double at_s = 0, at_degc = 0;
  Stimulus stimulus;
  if (reader.Number("at_s", &at_s, Range::Between(0, DurationRange().high))) stimulus.at_s = at_s;
  if (reader.Number("at_degc", &at_degc, SetPointRange(station))) stimulus.at_degc = at_degc;
  const std::optional<What> what = ReadWhat(&reader, station);
  reader.RefuseOtherKeys();
  if (reader.Has("at_s") == reader.Has("at_degc")) {
    reader.Complain("", "a stimulus starts either at_s or at_degc");
  }
  if (!what) reader.Complain("", "a stimulus holds one tone, music, sweep, move or load");
  if (!what) return std::nullopt;
  stimulus.what = *what;
  return stimulus;
}

}  // namespace

std::optional<double> SetPointOf(const Action& action) {
  if (const Soak* soak = std::get_if<Soak>(&action)) return soak->to_degc;
  if (const Ramp* ramp = std::get_if<Ramp>(&action)) return ramp->to_degc;
  return std::nullopt;
}

std::optional<Action> ReadAction(TableReader* step, const Station& station) {
  std::optional<Action> action;
  int kinds = 0;
  for (const std::string& kind : kLater) {
    if (!step->Has(kind)) continue;
    ++kinds;
    step->Complain(kind, fmt::format("'{}' is not supported by this version; it knows {}", kind,
                                     fmt::join(kKinds, ", ")));
  }
  for (const std::string& kind : kKinds) {
    if (!step->Has(kind)) continue;
    if (++kinds > 1) {
      step->Complain(kind, fmt::format("a step does one thing; '{}' wants its own [[step]]", kind));
    }
    const TableReader table = step->Table(kind);
    if (table.present()) action = ReadKind(kind, table, station);
  }
  return action;
}

std::vector<Stimulus> ReadStimuli(TableReader* step, const Station& station,
                                  const std::optional<Action>& action,
                                  std::optional<double> from_degc) {
  std::vector<Stimulus> stimuli;
  for (const TableReader& table : step->Tables("with")) {
    const std::optional<Stimulus> stimulus = ReadStimulus(table, station);
    if (!stimulus) continue;
    if (action) CheckStart(*action, from_degc, *stimulus, table);
    stimuli.push_back(*stimulus);
  }
  return stimuli;
}

}  // namespace zrobench
