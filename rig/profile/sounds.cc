#include "rig/profile/sounds.h"

#include <fmt/format.h>

#include <cmath>

#include "core/units.h"
#include "rig/profile/limits.h"

namespace zrobench {
namespace {

constexpr double kMinDwell_s = 0.2;   // two ticks, so that every tone of a sweep sounds
constexpr double kMostTones = 10000;  // of one sweep
constexpr double kMinTone_v = 1e-6;   // far below any generator's smallest step

Range ToneRange(const Station& station) {
  return Limited(station.limits.min_tone_hz, station.limits.max_tone_hz,
                 LimitOf(station, "min_tone_hz"), LimitOf(station, "max_tone_hz"));
}

/// What a station allows in one go; its transducer then wants a pause.
Range SoundRange(const Station& station) {
  return Limited(DurationRange().low, station.limits.max_tone_s, "the bench's tick",
                 LimitOf(station, "max_tone_s"));
}

/// spl_db, and the voltage that it takes by the speaker's nominal sensitivity: either may hit its
/// own limit.
void ReadSpl(TableReader* reader, const Station& station, double* spl_db, double* v) {
  const StationLimits& limits = station.limits;
  const Range spl =
      Limited(0, limits.max_spl_db, "the threshold of hearing", LimitOf(station, "max_spl_db"));
  if (!reader->Number("spl_db", spl_db, spl)) return;
  *v = PaFromSplDb(*spl_db) / station.model.speaker.pa_per_v;
  if (*v <= limits.max_tone_v) return;
  reader->Complain("spl_db", fmt::format("spl_db = {} takes {:.3g} V, above {} ({})", *spl_db, *v,
                                         limits.max_tone_v, LimitOf(station, "max_tone_v")));
}

void ReadLevel(TableReader* reader, const Station& station, Tone* tone) {
  const bool has_v = reader->Has("v"), has_spl = reader->Has("spl_db");
  if (has_v == has_spl) {
    reader->Complain(has_v ? "v" : "", "a tone wants either spl_db or v");
    return;
  }
  if (has_spl) return ReadSpl(reader, station, &tone->spl_db, &tone->v);
  const StationLimits& limits = station.limits;
  const Range v =
      Limited(kMinTone_v, limits.max_tone_v, "a microvolt", LimitOf(station, "max_tone_v"));
  if (!reader->Number("v", &tone->v, v)) return;
  tone->spl_db = SplDbFromPa(tone->v * station.model.speaker.pa_per_v);
  if (tone->spl_db <= limits.max_spl_db) return;
  reader->Complain("v",
                   fmt::format("v = {} makes {:.1f} dB SPL, above {} ({})", tone->v, tone->spl_db,
                               limits.max_spl_db, LimitOf(station, "max_spl_db")));
}

void WantSpeaker(TableReader* reader, const Station& station) {
  if (!station.speaker.empty()) return;
  reader->Complain("", fmt::format("station {} has no speaker", station.path.string()));
}

/// How long it all takes, and whether a station stands it.
void MeasureSweep(TableReader* reader, const Station& station, Sweep* sweep) {
  const double tones = sweep->tones();
  sweep->for_s = tones * sweep->dwell_s;
  const StationLimits& limits = station.limits;
  if (tones > kMostTones) {
    reader->Complain("step_hz", fmt::format("step_hz = {} makes {:.3g} tones of it; {:g} are the "
                                            "most",
                                            sweep->step_hz, tones, kMostTones));
  } else if (sweep->for_s > limits.max_tone_s) {
    reader->Complain("dwell_s", fmt::format("{:g} tones of {} s last {:g} s, above {} ({})", tones,
                                            sweep->dwell_s, sweep->for_s, limits.max_tone_s,
                                            LimitOf(station, "max_tone_s")));
  }
}

}  // namespace

Tone ReadTone(TableReader reader, const Station& station) {
  Tone tone;
  reader.Number("hz", &tone.hz, ToneRange(station));
  ReadLevel(&reader, station, &tone);
  reader.Number("for_s", &tone.for_s, SoundRange(station));
  reader.Require({"hz", "for_s"});
  reader.RefuseOtherKeys();
  WantSpeaker(&reader, station);
  return tone;
}

Music ReadMusic(TableReader reader, const Station& station) {
  Music music;
  const bool low = reader.Number("low_hz", &music.low_hz, ToneRange(station));
  const bool high = reader.Number("high_hz", &music.high_hz, ToneRange(station));
  ReadSpl(&reader, station, &music.spl_db, &music.v);
  reader.Number("for_s", &music.for_s, SoundRange(station));
  reader.Require({"low_hz", "high_hz", "spl_db", "for_s"});
  reader.RefuseOtherKeys();
  if (low && high && music.high_hz < music.low_hz + 1) {
    reader.Complain("high_hz", fmt::format("high_hz = {} is not 1 Hz or more above low_hz = {}: "
                                           "music has a band",
                                           music.high_hz, music.low_hz));
  }
  WantSpeaker(&reader, station);
  return music;
}

Sweep ReadSweep(TableReader reader, const Station& station) {
  Sweep sweep;
  const Range step = Limited(0.01, 1e6, "a hundredth of a hertz", "more than any span");
  const Range dwell = Limited(kMinDwell_s, station.limits.max_tone_s, "two of the bench's ticks",
                              LimitOf(station, "max_tone_s"));
  bool good = reader.Number("from_hz", &sweep.from_hz, ToneRange(station));
  good &= reader.Number("to_hz", &sweep.to_hz, ToneRange(station));
  good &= reader.Number("step_hz", &sweep.step_hz, step);
  ReadSpl(&reader, station, &sweep.spl_db, &sweep.v);
  good &= reader.Number("dwell_s", &sweep.dwell_s, dwell);
  reader.Require({"from_hz", "to_hz", "step_hz", "spl_db", "dwell_s"});
  reader.RefuseOtherKeys();
  if (good) MeasureSweep(&reader, station, &sweep);
  WantSpeaker(&reader, station);
  return sweep;
}

double Sweep::tones() const { return 1 + std::floor(std::abs(to_hz - from_hz) / step_hz + 1e-9); }

double Sweep::HzOf(double tone) const {
  return from_hz + (to_hz < from_hz ? -tone : tone) * step_hz;
}

}  // namespace zrobench
