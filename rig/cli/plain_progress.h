#pragma once
#include "core/clock.h"
#include "rig/run/run_log.h"

namespace zrobench {

/// Progress as plain lines on standard error: one an event, a heartbeat every 30 s of real time,
/// no escapes, at most 100 columns. Stamps are bench time.
class PlainProgress final : public RunObserver {
 public:
  /// `expected_s`: how long the profile should take, for the ETA; `epoch`: wall time of clock 0.
  PlainProgress(UtcNs epoch, double expected_s) : epoch_(epoch), expected_s_(expected_s) {}
  void OnItem(const Item& item, const RunSnapshot& snapshot) override;

 private:
  void Line(std::uint64_t at_us, const std::string& text) const;
  void OnEvent(const EventItem& event, const RunSnapshot& snapshot);
  void OnRejections(const RunSnapshot& snapshot);
  void Heartbeat(const RunSnapshot& snapshot);
  std::string Eta(std::uint64_t at_us) const;

  UtcNs epoch_;
  double expected_s_;
  RealClock real_;
  Instant next_beat_ = Instant(std::chrono::seconds(30));
  std::uint32_t rejections_shown_ = 0;
};

}  // namespace zrobench
