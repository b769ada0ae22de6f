#pragma once
// The board's protocol around a corrector: a CiA 301 subset on node id 0x10 (message layout:
// corrector/node/zrobench.dbc; objects: object_dictionary.h). Freestanding.
#include <cstdint>

#include "corrector/corrector.h"
#include "corrector/node/frame.h"
#include "corrector/node/raw_sample.h"

namespace zro::node {

struct Identity {
  std::uint8_t fw_major, fw_minor, fw_patch, hw_rev;
  std::uint32_t build_id, serial;
};

enum class BootReason : std::uint8_t {
  kUnknown, kPowerOn, kPin, kBrownOut, kWatchdog, kSoftware, kLockup, kBootloader
};

/// One powered-on life of the board. A reset is a new Node over the same storage.
/// The caller (HAL, virtual board, host replica) feeds it frames, samples and milliseconds.
class Node {
 public:
  static constexpr std::uint8_t kNodeId = 0x10;

  /// All pointers are borrowed. `time_divider`: DUT_TIME and DUT_CORR go out every n-th sample.
  Node(const Identity& identity, const Config& config, Storage* storage, FrameSink* sink,
       std::uint16_t time_divider = 10);

  /// Boots the corrector, sends boot-up heartbeat and identity, then is operational and streams.
  void Boot(BootReason reason, std::uint16_t boot_count);

  /// A frame from the bus. Answers at once through the sink. NMT reset sets reset_requested().
  void OnFrame(const Frame& frame);

  /// One sensor instant. Sends, in this order: [DUT_TIME], DUT_RAW, DUT_ACC, DUT_RATE, [DUT_CORR],
  /// then EMCY for rejections. raw.temperature is used (and sent) only when a DUT_TIME is due: the
  /// corrector sees exactly what the bus shows.
  void OnSample(const RawSample& raw);

  /// Device time since boot; drives heartbeat (500 ms), status (1 s), identity (10 s) and the
  /// watch over the rig's heartbeat (1.5 s; its loss clears the test modes).
  void OnTime(std::uint32_t now_ms);

  bool reset_requested() const { return reset_requested_; }
  const Corrector& corrector() const { return corrector_; }

 private:
  // private parts are the node room's own
  Corrector corrector_;
  FrameSink* sink_;
  bool reset_requested_ = false;
};

}  // namespace zro::node
