#pragma once
// One way out for everything a run learns: into the record, into the live snapshot, to the watcher.
#include <string>

#include "core/clock.h"
#include "rig/record/item.h"
#include "rig/record/recorder.h"
#include "rig/record/snapshot.h"

namespace zrobench {

/// Sees a run while it grows (plain progress lines, a dashboard). Called on the controller thread
/// for the rare items only (events, decisions, tables, plate readings): never per sample.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void OnItem(const Item& item, const RunSnapshot& snapshot) = 0;
};

class RunLog {
 public:
  /// Borrows all; `observer` may be null.
  RunLog(Recorder& recorder, const Clock& clock, RunObserver* observer)
      : recorder_(recorder), clock_(clock), observer_(observer) {}

  /// Every sample goes through here: no allocation, no observer.
  void WriteSample(const ImuSample& sample) {
    recorder_.Write(sample);
    Reduce(snapshot_, sample);
  }
  template <typename T>
  void Write(const T& item) {
    recorder_.Write(item);
    Reduce(snapshot_, item);
    if (observer_) observer_->OnItem(item, snapshot_);
  }
  /// The state so far, where late readers may begin.
  void WriteSnapshot() { recorder_.Write(SnapshotItem{now_us(), ToJson(snapshot_)}); }
  void WriteEvent(EventItem event) {
    event.at_us = now_us();
    event.step = step_;
    Write(event);
  }
  void Alarm(std::string text) {
    WriteEvent({.kind = EventItem::Kind::kAlarm, .text = std::move(text)});
  }
  void Note(std::string text) {
    WriteEvent({.kind = EventItem::Kind::kNote, .text = std::move(text)});
  }

  void set_step(int step) { step_ = step; }
  const RunSnapshot& snapshot() const { return snapshot_; }
  Recorder& recorder() { return recorder_; }
  std::uint64_t now_us() const {
    return static_cast<std::uint64_t>(clock_.now().time_since_epoch().count() / 1000);
  }

 private:
  Recorder& recorder_;
  const Clock& clock_;
  RunObserver* observer_;
  RunSnapshot snapshot_;
  int step_ = -1;
};

}  // namespace zrobench
