#pragma once
// The virtual IMU board: the real corrector and node behind simulated sensors. It sees nothing of
// the world but its sensors' integers and the bus.
#include <cstdint>
#include <optional>

#include "core/clock.h"
#include "corrector/node/node.h"
#include "rig/physics/rig_model.h"
#include "rig/station/station.h"
#include "rig/virtual/flash.h"

namespace zrobench {

class VirtualBoard {
 public:
  /// Ships the board: its flash gets the factory's entries, measured with the station's error.
  /// `sink` is borrowed.
  VirtualBoard(const Station& station, std::uint64_t seed, zro::node::FrameSink& sink);

  void PowerOn(Instant now);
  /// Supply gone, whatever it was doing. The flash keeps what was committed.
  void PowerOff();
  bool on() const { return node_.has_value(); }

  /// How hard the board works, 0..100 %; 0 while off.
  double load_pct() const { return on() ? node_->load_pct() : 0; }

  /// When the next sample is due; Instant::max() while off.
  Instant next_sample() const { return next_sample_; }
  /// Samples the sensors (due at next_sample()) and lets the node work.
  void Sample(const physics::Sensed& sensed, double die_degc);
  /// A frame from the bus. Restarts the node when it asks for a reset.
  void Deliver(const zro::node::Frame& frame);

 private:
  void ShipFromFactory(std::uint64_t seed);
  void StartNode(zro::node::BootReason reason);
  zro::node::RawSample Quantise(const physics::Sensed& sensed, double die_degc);

  VirtualSettings settings_;
  physics::Model model_;
  zro::Config config_;
  zro::node::FrameSink& sink_;
  VirtualFlash flash_;
  std::optional<zro::node::Node> node_;
  std::uint16_t boot_count_ = 0;
  std::uint16_t counter_ = 0;
  std::uint8_t range_code_ = 0;
  std::uint64_t samples_since_boot_ = 0;
  Instant booted_{};
  Instant next_sample_ = Instant::max();
};

}  // namespace zrobench
