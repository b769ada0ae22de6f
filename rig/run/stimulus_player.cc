#include "rig/run/stimulus_player.h"

#include <fmt/format.h>

#include <algorithm>

namespace zrobench {
namespace {

constexpr auto kDeadline = std::chrono::seconds(2);

double Length_s(const Stimulus& stimulus) {
  return std::visit([](const auto& what) { return what.for_s; }, stimulus.what);
}

struct Describer {
  EventItem event;
  EventItem operator()(const Tone& tone) {
    event.a = tone.hz;
    event.b = tone.spl_db;
    return Named("tone");
  }
  EventItem operator()(const Music& music) {
    event.b = music.spl_db;
    return Named(fmt::format("music {:g}-{:g} Hz", music.low_hz, music.high_hz));
  }
  EventItem operator()(const Sweep& sweep) {
    event.b = sweep.spl_db;
    return Named(fmt::format("sweep {:g}-{:g} Hz", sweep.from_hz, sweep.to_hz));
  }
  EventItem operator()(const Move& move) { return Named("move " + move.how); }
  EventItem operator()(const Load& load) {
    event.a = event.kind == EventItem::Kind::kStimulusBegin ? load.duty_pct : 0;
    event.kind = EventItem::Kind::kLoad;
    return Named("load");
  }
  EventItem Named(std::string text) {
    event.text = std::move(text);
    return event;
  }
};

EventItem Describe(const Stimulus& stimulus, EventItem::Kind kind) {
  return std::visit(Describer{{.kind = kind}}, stimulus.what);
}

bool IsLoad(const Stimulus& stimulus) { return std::holds_alternative<Load>(stimulus.what); }

/// Whether both want the same instrument.
bool Share(const Stimulus& a, const Stimulus& b) {
  return a.what.index() == b.what.index() || (Sounds(a) && Sounds(b));
}

}  // namespace

void StimulusPlayer::Schedule(const std::vector<Stimulus>& stimuli) {
  slots_.clear();
  for (const Stimulus& stimulus : stimuli) Add(stimulus);
  step_start_ = bench_.clock.now();
}

bool StimulusPlayer::playing() const {
  return std::any_of(slots_.begin(), slots_.end(),
                     [](const Slot& s) { return s.state == Slot::State::kPlaying; });
}

bool StimulusPlayer::provoking() const {
  return std::any_of(slots_.begin(), slots_.end(), [](const Slot& s) {
    return s.state == Slot::State::kPlaying && !IsLoad(s.stimulus);
  });
}

int StimulusPlayer::waiting() const {
  return static_cast<int>(std::count_if(slots_.begin(), slots_.end(), [](const Slot& s) {
    return s.state == Slot::State::kWaiting || s.state == Slot::State::kDue;
  }));
}

bool StimulusPlayer::Comes(Slot& slot, std::optional<double> board_degc) const {
  if (slot.stimulus.at_s) {
    return bench_.clock.now() >= step_start_ + FromSeconds(*slot.stimulus.at_s);
  }
  if (!slot.stimulus.at_degc) return true;
  if (!board_degc) return false;
  const bool below = *board_degc < *slot.stimulus.at_degc;
  const bool passed = slot.was_below && *slot.was_below != below;
  slot.was_below = below;
  return passed;
}

bool StimulusPlayer::Busy(const Slot& slot) const {
  return std::any_of(slots_.begin(), slots_.end(), [&](const Slot& s) {
    return s.state == Slot::State::kPlaying && Share(s.stimulus, slot.stimulus);
  });
}

Status StimulusPlayer::Update(std::optional<double> board_degc) {
  using enum Slot::State;
  for (Slot& slot : slots_) {
    if (slot.state != kPlaying) continue;
    if (bench_.clock.now() < slot.until) {
      if (Status sung = Sing(slot); !sung) return sung;
    } else if (Status ended = End(slot); !ended) {
      return ended;
    }
  }
  for (Slot& slot : slots_) {
    if (slot.state == kWaiting && Comes(slot, board_degc)) slot.state = kDue;
    if (slot.state != kDue || Busy(slot)) continue;
    if (Status begun = Begin(slot); !begun) return begun;
  }
  return {};
}

Status StimulusPlayer::Start(const Stimulus& stimulus) {
  if (const auto* move = std::get_if<Move>(&stimulus.what)) {
    return bench_.hand ? bench_.hand->StartMove(move->how, FromSeconds(move->for_s))
                       : Fail(Error::Kind::kRefused, "nobody is there to move the board");
  }
  if (const auto* load = std::get_if<Load>(&stimulus.what)) {
    return bench_.board.SetLoad(load->duty_pct, bench_.clock.now() + kDeadline);
  }
  if (std::holds_alternative<Music>(stimulus.what) && !bench_.speaker.plays_music()) {
    return Fail(Error::Kind::kRefused, "this generator knows sines only");
  }
  return {};
}

Status StimulusPlayer::Sing(Slot& slot) {
  const Instant now = bench_.clock.now();
  const Sound sound = SoundAt(slot.stimulus, ToSeconds(now - slot.from));
  if (sound == slot.sound) return {};
  const double half_hz = sound.band_hz / 2;
  const Status on = sound.band_hz > 0
                        ? bench_.speaker.SetMusic(sound.hz - half_hz, sound.hz + half_hz, sound.v,
                                                  now + kDeadline)
                        : bench_.speaker.SetTone(sound.hz, sound.v, now + kDeadline);
  if (!on) return on;
  slot.sound = sound;
  log_.Write(SpeakerItem{log_.now_us(), sound.hz, sound.v, sound.spl_db, sound.band_hz});
  return {};
}

Status StimulusPlayer::Begin(Slot& slot) {
  slot.state = Slot::State::kOver;  // until it plays: what fails or is skipped is not tried again
  slot.from = bench_.clock.now();
  slot.until = slot.from + FromSeconds(Length_s(slot.stimulus));
  const EventItem begin = Describe(slot.stimulus, EventItem::Kind::kStimulusBegin);
  if (const Status started = Start(slot.stimulus); !started) {
    if (started.error().kind != Error::Kind::kRefused) return started;
    log_.Alarm(begin.text + " skipped: " + started.error().message);
    return {};
  }
  // Recorded before the sound starts: the stimulus is never shorter than the record says.
  log_.WriteEvent(begin);
  slot.state = Slot::State::kPlaying;
  return Sing(slot);
}

Status StimulusPlayer::End(Slot& slot) {
  slot.state = Slot::State::kOver;
  const Instant deadline = bench_.clock.now() + kDeadline;
  if (Sounds(slot.stimulus)) {
    if (Status off = bench_.speaker.Mute(deadline); !off) return off;
    log_.Write(SpeakerItem{log_.now_us(), 0, 0, 0});
  }
  if (IsLoad(slot.stimulus)) {
    if (Status off = bench_.board.SetLoad(0, deadline); !off) return off;
  }
  log_.WriteEvent(Describe(slot.stimulus, EventItem::Kind::kStimulusEnd));
  return {};
}

Status StimulusPlayer::Abort() {
  Status first;
  for (Slot& slot : slots_) {
    if (slot.state != Slot::State::kPlaying) continue;
    if (Status ended = End(slot); !ended && first) first = ended;
  }
  return first;
}

}  // namespace zrobench
