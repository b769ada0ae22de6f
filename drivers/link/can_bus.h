#pragma once
// The seam at frames: SocketCAN, slcan and the in-memory bus look the same from above.
#include <cstdint>
#include <optional>

#include "core/clock.h"
#include "core/result.h"
#include "corrector/node/frame.h"

namespace zrobench {

struct CanFrame {
  zro::node::Frame frame{};
  Instant at{};      ///< clock time at receipt (bus time where the adapter gives it)
  bool own = false;  ///< sent by us; comes back in bus order, as SocketCAN's own-message echo does
};

/// Cumulative since open. A check is invalid if `lost` moved while it ran.
struct CanHealth {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t lost = 0;  ///< frames known to be dropped between bus and us
  std::uint64_t error_frames = 0;
  bool bus_off = false;
};

/// One node's access to a bus. Thread-compatible.
class CanBus : public WaitSource {
 public:
  /// Next frame in bus order, own ones included; nothing when there is none. Never blocks.
  virtual std::optional<CanFrame> Receive() = 0;
  /// Queues a frame. kTimeout when the queue stays full, kClosed when the bus is gone.
  virtual Status Send(const zro::node::Frame& frame) = 0;
  virtual CanHealth health() const = 0;
};

}  // namespace zrobench
