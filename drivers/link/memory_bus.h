#pragma once
// A CAN bus in memory, between the rig and one board that lives in the same program.
#include <cstddef>
#include <vector>

#include "core/clock.h"
#include "drivers/link/can_bus.h"

namespace zrobench {

/// This object is the rig's end. The board's end is board_sink() (frames from the board, seen by
/// the rig at once) and BoardReceive() (frames from the rig). Frames are stamped with the clock's
/// time.
///
/// A rig frame is on the bus as soon as it is sent: whoever owns the board lets it receive before
/// it does anything else, so that bus order is the order in which the board saw things.
///
/// Both directions are bounded and allocate once. A board frame that finds the rig's queue full is
/// lost and counted, as in a socket's buffer; a rig frame that finds the board's full fails with
/// kTimeout. Not thread-safe.
class MemoryBus final : public CanBus {
 public:
  /// The clock is borrowed. `capacity` frames wait for the rig at most, kBoardCapacity for the
  /// board.
  explicit MemoryBus(const Clock& clock, std::size_t capacity = 16384);

  bool ready() const override { return !to_rig_.empty(); }
  std::optional<CanFrame> Receive() override;
  Status Send(const zro::node::Frame& frame) override;
  CanHealth health() const override { return health_; }

  /// Borrowed from the bus.
  zro::node::FrameSink& board_sink() { return board_sink_; }
  /// The oldest frame sent by the rig that the board has not got yet.
  std::optional<zro::node::Frame> BoardReceive();
  /// Whether BoardReceive() would give one.
  bool board_pending() const { return !to_board_.empty(); }

 private:
  static constexpr std::size_t kBoardCapacity = 256;

  class Ring {
   public:
    explicit Ring(std::size_t capacity) : frames_(capacity) {}
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == frames_.size(); }
    void Push(const zro::node::Frame& frame, Instant at, bool own);
    CanFrame Pop();

   private:
    std::vector<CanFrame> frames_;
    std::size_t head_ = 0, size_ = 0;
  };

  class BoardSink final : public zro::node::FrameSink {
   public:
    explicit BoardSink(MemoryBus* bus) : bus_(bus) {}
    void Send(const zro::node::Frame& frame) override { bus_->Deliver(frame, false); }

   private:
    MemoryBus* bus_;
  };

  void Deliver(const zro::node::Frame& frame, bool own);

  const Clock& clock_;
  Ring to_rig_;
  Ring to_board_{kBoardCapacity};
  BoardSink board_sink_{this};
  CanHealth health_;
};

}  // namespace zrobench
