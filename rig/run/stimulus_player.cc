#include "rig/run/stimulus_player.h"

#include <algorithm>

namespace zrobench {
namespace {

constexpr auto kDeadline = std::chrono::seconds(2);

double Length_s(const Stimulus& stimulus) {
  return std::visit([](const auto& what) { return what.for_s; }, stimulus.what);
}

EventItem Describe(const Stimulus& stimulus, EventItem::Kind kind) {
  EventItem event{.kind = kind};
  if (const auto* tone = std::get_if<Tone>(&stimulus.what)) {
    event.text = "tone";
    event.a = tone->hz;
    event.b = tone->spl_db;
  } else {
    event.text = "move " + std::get<Move>(stimulus.what).how;
  }
  return event;
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
    return s.state == Slot::State::kPlaying &&
           s.stimulus.what.index() == slot.stimulus.what.index();
  });
}

Status StimulusPlayer::Update(std::optional<double> board_degc) {
  using enum Slot::State;
  for (Slot& slot : slots_) {
    if (slot.state != kPlaying || bench_.clock.now() < slot.until) continue;
    if (Status ended = End(slot); !ended) return ended;
  }
  for (Slot& slot : slots_) {
    if (slot.state == kWaiting && Comes(slot, board_degc)) slot.state = kDue;
    if (slot.state != kDue || Busy(slot)) continue;
    if (Status begun = Begin(slot); !begun) return begun;
  }
  return {};
}

Status StimulusPlayer::Begin(Slot& slot) {
  slot.state = Slot::State::kOver;  // until it plays: what fails or is skipped is not tried again
  const Instant now = bench_.clock.now();
  const Stimulus& stimulus = slot.stimulus;
  if (const auto* move = std::get_if<Move>(&stimulus.what)) {
    const Status moved = bench_.hand
                             ? bench_.hand->StartMove(move->how, FromSeconds(move->for_s))
                             : Fail(Error::Kind::kRefused, "nobody is there to move the board");
    if (!moved && moved.error().kind != Error::Kind::kRefused) return moved;
    if (!moved) {
      log_.Alarm("move " + move->how + " skipped: " + moved.error().message);
      return {};
    }
  }
  // Recorded before the sound starts: the stimulus is never shorter than the record says.
  log_.WriteEvent(Describe(stimulus, EventItem::Kind::kStimulusBegin));
  slot.state = Slot::State::kPlaying;
  slot.until = now + FromSeconds(Length_s(stimulus));
  if (const auto* tone = std::get_if<Tone>(&stimulus.what)) {
    if (Status on = bench_.speaker.SetTone(tone->hz, tone->v, now + kDeadline); !on) return on;
    log_.Write(SpeakerItem{log_.now_us(), tone->hz, tone->v, tone->spl_db});
  }
  return {};
}

Status StimulusPlayer::End(Slot& slot) {
  slot.state = Slot::State::kOver;
  if (std::holds_alternative<Tone>(slot.stimulus.what)) {
    if (Status off = bench_.speaker.Mute(bench_.clock.now() + kDeadline); !off) return off;
    log_.Write(SpeakerItem{log_.now_us(), 0, 0, 0});
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
