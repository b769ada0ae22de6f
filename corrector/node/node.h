#pragma once
// The board's protocol around a corrector: a CiA 301 subset on node id 0x10 (message layout:
// corrector/node/zrobench.dbc; objects: object_dictionary.h). Freestanding.
#include <cstdint>

#include "corrector/corrector.h"
#include "corrector/node/codec.h"
#include "corrector/node/event_log.h"
#include "corrector/node/frame.h"
#include "corrector/node/identity.h"
#include "corrector/node/object_dictionary.h"
#include "corrector/node/raw_sample.h"
#include "corrector/node/sdo_server.h"
#include "corrector/node/test_modes.h"

namespace zro::node {

enum class BootReason : std::uint8_t {
  kUnknown,
  kPowerOn,
  kPin,
  kBrownOut,
  kWatchdog,
  kSoftware,
  kLockup,
  kBootloader
};

/// Samples between two DUT_TIME (and DUT_CORR): 20 a second, whatever the sample rate.
inline std::uint16_t TimeDividerFor(float sample_hz) {
  const float divider = sample_hz / 20.0f + 0.5f;
  return divider < 1.0f ? 1 : static_cast<std::uint16_t>(divider);
}

/// One powered-on life of the board. A reset is a new Node over the same storage.
/// The caller (HAL, virtual board, host replica) feeds it frames, samples and milliseconds.
///
/// What the corrector does depends on Boot(), OnSample(), and the frames TIME_STAMP, NMT, rig
/// heartbeat and SDO writes alone, in their order; never on OnTime(). So whoever feeds a second
/// node the same frames and the samples of the bus gets the same outputs, bit for bit. Unlike the
/// rest, raw.temperature need only be right where a DUT_TIME is due.
class Node {
 public:
  static constexpr std::uint8_t kNodeId = 0x10;
  static constexpr std::uint32_t kRigHeartbeatMs = 1500;  ///< consumer time (CiA 301, 0x1016)

  /// All pointers are borrowed. `time_divider`: DUT_TIME and DUT_CORR go out every n-th sample.
  Node(const Identity& identity, const Config& config, Storage* storage, FrameSink* sink,
       std::uint16_t time_divider = 10);
  Node(const Node&) = delete;  // its parts point at each other
  Node& operator=(const Node&) = delete;

  /// Boots the corrector, sends boot-up heartbeat and identity, then is operational and streams.
  void Boot(BootReason reason, std::uint16_t boot_count);

  /// A frame from the bus. Answers at once through the sink. NMT reset sets reset_requested() and
  /// ends this life: the node is then deaf and mute. Stopped, it hears NMT and heartbeat only.
  void OnFrame(const Frame& frame);

  /// One sensor instant. Sends, in this order: [DUT_TIME], DUT_RAW, DUT_ACC, DUT_RATE, [DUT_CORR],
  /// then EMCY for rejections. raw.temperature is used (and sent) only when a DUT_TIME is due
  /// (first sample after a boot or NMT start, then every time_divider-th): the corrector sees
  /// exactly what the bus shows. Not operational, the sample is dropped, and the next one shows a
  /// gap.
  void OnSample(const RawSample& raw);

  /// Device time since boot; drives heartbeat (500 ms), status (1 s), identity (10 s) and
  /// RigHeartbeatOk. The test modes' dead man's handle (1.5 s after the last rig heartbeat or
  /// unlock) counts sample periods instead: see test_modes.h.
  void OnTime(std::uint32_t now_ms);

  bool reset_requested() const { return reset_requested_; }
  std::uint8_t nmt_state() const { return nmt_state_; }
  const Corrector& corrector() const { return corrector_; }
  const EventLog& log() const { return log_; }
  /// How hard the host wants the board to work, 0..100 %: the firmware burns that share of its
  /// time.
  std::uint8_t load_pct() const { return test_modes_.load_pct(); }
  /// What the last OnSample() gave; all zero before the first.
  const Output& last_output() const { return output_; }

 private:
  struct Timer {  // true once a period, on time even if called late
    std::uint32_t next_ms = 0;
    bool Due(std::uint32_t now_ms, std::uint32_t period_ms);
  };

  bool operational() const { return nmt_state_ == kStateOperational; }
  void OnNmt(const NmtMsg& message);
  Sample NextSample(const RawSample& raw, bool time_due);
  void SendTime(const RawSample& raw);
  void SendRaw(const RawSample& raw);
  void SendRate(std::uint8_t seq, const Sample& sample, bool temp_fresh);
  void SendCorrection();
  void SendHeartbeat();
  void SendStatus();
  void SendIdentity();
  void DrainEvents();
  void SendEmergency(const Event& event);
  std::uint32_t DeviceMicroseconds(std::uint32_t sample) const;
  std::uint8_t nv_state() const;

  Identity identity_;
  Corrector corrector_;
  FrameSink* sink_;
  EventLog log_;
  TestModes test_modes_;
  ObjectDictionary objects_;
  SdoServer sdo_;

  std::uint16_t time_divider_;
  std::uint32_t period_ns_;
  bool reset_requested_ = false;
  std::uint8_t nmt_state_ = kStateBootUp;
  BootReason boot_reason_ = BootReason::kUnknown;
  std::uint16_t boot_count_ = 0;

  bool first_sample_ = true;      // since boot
  std::uint16_t until_time_ = 0;  // samples before the next DUT_TIME
  std::uint16_t last_counter_ = 0;
  std::uint32_t periods_ = 0;     // nominal sample periods since the first sample
  std::int16_t temperature_ = 0;  // as last sent
  Output output_{};

  std::uint32_t rejections_ = 0;
  std::uint32_t now_ms_ = 0;
  bool rig_heard_ = false;
  std::uint32_t rig_heard_ms_ = 0;
  Timer heartbeat_, status_, ident_;
};

}  // namespace zro::node
