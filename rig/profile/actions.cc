#include "rig/profile/actions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/units.h"
#include "rig/profile/dew_point.h"

namespace zrobench {
namespace {

constexpr double kWeekS = 7 * 86400.0;  // longer is a slip of units

const std::vector<std::string> kKinds = {"soak", "ramp",        "hold", "tone",
                                         "move", "power_cycle", "date"};
// Named by the format, not driven by this version: refused, so that nothing is left out silently.
const std::vector<std::string> kLater = {"music", "sweep", "load", "confirm"};
const std::vector<std::string> kMoves = {"tap", "rotate", "vibrate", "hand_held"};

std::string LimitOf(const Station& station, std::string_view key) {
  return fmt::format("{} of station {}", key, station.path.string());
}

Range DurationRange() {
  Range range = Range::Positive(kWeekS);
  range.high_reason = "seven days";
  return range;
}

Range Limited(double low, double high, const std::string& low_reason,
              const std::string& high_reason) {
  Range range = Range::Between(low, high);
  range.low_reason = low_reason;
  range.high_reason = high_reason;
  return range;
}

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
  reader.Number("settled_degc", &soak.settled_degc, Range::Positive(10));
  reader.Require({"to_degc", "hold_s"});
  reader.RefuseOtherKeys();
  return soak;
}

Ramp ReadRamp(TableReader reader, const Station& station) {
  Ramp ramp;
  Range rate = Range::Positive(station.limits.max_rate_degc_per_min);
  rate.high_reason = LimitOf(station, "max_rate_degc_per_min");
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

// The other level follows from the speaker's nominal sensitivity; either may hit its own limit.
void ReadLevel(TableReader* reader, const Station& station, Tone* tone) {
  const bool has_v = reader->Has("v"), has_spl = reader->Has("spl_db");
  if (has_v == has_spl) {
    reader->Complain(has_v ? "v" : "", "a tone wants either spl_db or v");
    return;
  }
  const StationLimits& limits = station.limits;
  const double pa_per_v = station.model.speaker.pa_per_v;
  Range v = Range::Positive(limits.max_tone_v);
  v.high_reason = LimitOf(station, "max_tone_v");
  const Range spl =
      Limited(0, limits.max_spl_db, "the threshold of hearing", LimitOf(station, "max_spl_db"));
  if (has_spl && reader->Number("spl_db", &tone->spl_db, spl)) {
    tone->v = PaFromSplDb(tone->spl_db) / pa_per_v;
    if (tone->v <= limits.max_tone_v) return;
    reader->Complain("spl_db",
                     fmt::format("spl_db = {} takes {:.3g} V, above {} ({})", tone->spl_db, tone->v,
                                 limits.max_tone_v, v.high_reason));
  }
  if (has_v && reader->Number("v", &tone->v, v)) {
    tone->spl_db = SplDbFromPa(tone->v * pa_per_v);
    if (tone->spl_db <= limits.max_spl_db) return;
    reader->Complain("v", fmt::format("v = {} makes {:.1f} dB SPL, above {} ({})", tone->v,
                                      tone->spl_db, limits.max_spl_db, spl.high_reason));
  }
}

Tone ReadTone(TableReader reader, const Station& station) {
  Tone tone;
  const StationLimits& limits = station.limits;
  reader.Number("hz", &tone.hz,
                Limited(limits.min_tone_hz, limits.max_tone_hz, LimitOf(station, "min_tone_hz"),
                        LimitOf(station, "max_tone_hz")));
  ReadLevel(&reader, station, &tone);
  Range duration = Range::Positive(limits.max_tone_s);
  duration.high_reason = LimitOf(station, "max_tone_s");
  reader.Number("for_s", &tone.for_s, duration);
  reader.Require({"hz", "for_s"});
  reader.RefuseOtherKeys();
  if (station.speaker.empty()) {
    reader.Complain("", fmt::format("station {} has no speaker", station.path.string()));
  }
  return tone;
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

Action ReadKind(const std::string& kind, const TableReader& table, const Station& station) {
  if (kind == "soak") return ReadSoak(table, station);
  if (kind == "ramp") return ReadRamp(table, station);
  if (kind == "hold") return ReadHold(table);
  if (kind == "tone") return ReadTone(table, station);
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
  const Hold* hold = std::get_if<Hold>(&action);
  if (hold && stimulus.at_s && *stimulus.at_s >= hold->for_s) {
    reader.Complain("at_s", fmt::format("at_s = {} is after the hold's end at {} s", *stimulus.at_s,
                                        hold->for_s));
  }
}

// Each with its own start: `at_s` or `at_degc`.
std::optional<Stimulus> ReadStimulus(TableReader reader, const Station& station) {
  const TableReader tone = reader.Table("tone"), move = reader.Table("move");
  double at_s = 0, at_degc = 0;
  Stimulus stimulus;
  if (reader.Number("at_s", &at_s, Range::Between(0, kWeekS))) stimulus.at_s = at_s;
  if (reader.Number("at_degc", &at_degc, SetPointRange(station))) stimulus.at_degc = at_degc;
  reader.RefuseOtherKeys();
  if (reader.Has("at_s") == reader.Has("at_degc")) {
    reader.Complain("", "a stimulus starts either at_s or at_degc");
  }
  if (tone.present()) stimulus.what = ReadTone(tone, station);
  if (move.present()) stimulus.what = ReadMove(move);
  if (tone.present() != move.present()) return stimulus;
  reader.Complain("", "a stimulus holds either a tone or a move");
  return std::nullopt;
}

}  // namespace

std::optional<double> SetPointOf(const Action& action) {
  if (const Soak* soak = std::get_if<Soak>(&action)) return soak->to_degc;
  if (const Ramp* ramp = std::get_if<Ramp>(&action)) return ramp->to_degc;
  return std::nullopt;
}

Range SetPointRange(const Station& station) {
  return Limited(station.limits.min_degc, station.limits.max_degc, LimitOf(station, "min_degc"),
                 LimitOf(station, "max_degc"));
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
