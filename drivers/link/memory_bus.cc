#include "drivers/link/memory_bus.h"

#include <cstring>

#include "core/check.h"

namespace zrobench {

MemoryBus::MemoryBus(const Clock& clock, std::size_t capacity) : clock_(clock), to_rig_(capacity) {
  ZROBENCH_CHECK(capacity > 0);
}

void MemoryBus::Ring::Push(const zro::node::Frame& frame, Instant at, bool own) {
  std::size_t tail = head_ + size_;
  if (tail >= frames_.size()) tail -= frames_.size();
  CanFrame& slot = frames_[tail];
  // Field by field, as the node has just written them: one wide load would wait for the stores.
  slot.frame.id = frame.id;
  slot.frame.dlc = frame.dlc;
  std::memcpy(slot.frame.data, frame.data, sizeof frame.data);
  slot.at = at;
  slot.own = own;
  ++size_;
}

CanFrame MemoryBus::Ring::Pop() {
  const CanFrame frame = frames_[head_];
  ++head_;
  --size_;
  // An emptied ring starts over: a reader that keeps up stays within a few cache lines.
  if (size_ == 0 || head_ == frames_.size()) head_ = 0;
  return frame;
}

std::optional<CanFrame> MemoryBus::Receive() {
  if (to_rig_.empty()) return std::nullopt;
  const CanFrame frame = to_rig_.Pop();
  ++(frame.own ? health_.sent : health_.received);
  return frame;
}

Status MemoryBus::Send(const zro::node::Frame& frame) {
  if (to_board_.full()) {
    return Fail(Error::Kind::kTimeout, "memory bus: the board takes no frames (is it powered?)");
  }
  to_board_.Push(frame, clock_.now(), true);
  Deliver(frame, true);
  return {};
}

std::optional<zro::node::Frame> MemoryBus::BoardReceive() {
  if (to_board_.empty()) return std::nullopt;
  return to_board_.Pop().frame;
}

void MemoryBus::Deliver(const zro::node::Frame& frame, bool own) {
  if (to_rig_.full()) {
    ++health_.lost;
    return;
  }
  to_rig_.Push(frame, clock_.now(), own);
}

}  // namespace zrobench
