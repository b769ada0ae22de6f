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
  for (const Stimulus& stimulus : stimuli) slots_.push_back({stimulus, false, std::nullopt});
  step_start_ = bench_.clock.now();
}

int StimulusPlayer::waiting() const {
  return static_cast<int>(
      std::count_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.begun; }));
}

bool StimulusPlayer::Due(Slot& slot, std::optional<double> board_degc) const {
  if (slot.begun) return false;
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

Status StimulusPlayer::Update(std::optional<double> board_degc) {
  if (playing_ && bench_.clock.now() >= playing_->until) {
    if (Status ended = End(); !ended) return ended;
  }
  for (Slot& slot : slots_) {
    if (playing_ || !Due(slot, board_degc)) continue;
    slot.begun = true;
    if (Status begun = Begin(slot.stimulus); !begun) return begun;
  }
  return {};
}

Status StimulusPlayer::Begin(const Stimulus& stimulus) {
  const Instant now = bench_.clock.now();
  if (const auto* move = std::get_if<Move>(&stimulus.what)) {
    if (!bench_.hand) {
      log_.Note("move skipped: nobody is there to move the board");
      return {};
    }
    if (Status moved = bench_.hand->StartMove(move->how, FromSeconds(move->for_s)); !moved) {
      return moved;
    }
  }
  // Recorded before the sound starts: the stimulus is never shorter than the record says.
  log_.WriteEvent(Describe(stimulus, EventItem::Kind::kStimulusBegin));
  if (const auto* tone = std::get_if<Tone>(&stimulus.what)) {
    if (Status on = bench_.speaker.SetTone(tone->hz, tone->v, now + kDeadline); !on) return on;
    log_.Write(SpeakerItem{log_.now_us(), tone->hz, tone->v, tone->spl_db});
  }
  playing_ = Playing{stimulus, now + FromSeconds(Length_s(stimulus))};
  return {};
}

Status StimulusPlayer::End() {
  const Stimulus stimulus = playing_->stimulus;
  playing_.reset();
  if (std::holds_alternative<Tone>(stimulus.what)) {
    if (Status off = bench_.speaker.Mute(bench_.clock.now() + kDeadline); !off) return off;
    log_.Write(SpeakerItem{log_.now_us(), 0, 0, 0});
  }
  log_.WriteEvent(Describe(stimulus, EventItem::Kind::kStimulusEnd));
  return {};
}

Status StimulusPlayer::Abort() { return playing_ ? End() : Status{}; }

}  // namespace zrobench
