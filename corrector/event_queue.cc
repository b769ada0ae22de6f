#include "corrector/event_queue.h"

namespace zro {

void EventQueue::Push(Event event) {
  event.seq = next_seq_++;
  if (count_ == kCapacity) {
    first_ = static_cast<std::uint8_t>((first_ + 1) % kCapacity);
    --count_;
    ++lost_;
  }
  events_[(first_ + count_) % kCapacity] = event;
  ++count_;
}

bool EventQueue::Pop(Event* out) {
  if (count_ == 0) return false;
  *out = events_[first_];
  first_ = static_cast<std::uint8_t>((first_ + 1) % kCapacity);
  --count_;
  return true;
}

}  // namespace zro
