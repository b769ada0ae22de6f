#pragma once
#include <cstdint>

#include "corrector/types.h"

namespace zro {

/// The latest events not yet taken, oldest first. When full the oldest give way and are counted.
class EventQueue {
 public:
  static constexpr int kCapacity = 7;  // a step makes at most five

  /// Numbers the event and keeps it.
  void Push(Event event);
  bool Pop(Event* out);
  std::uint32_t lost() const { return lost_; }

 private:
  Event events_[kCapacity];
  std::uint32_t next_seq_ = 0;
  std::uint32_t lost_ = 0;
  std::uint8_t first_ = 0;
  std::uint8_t count_ = 0;
};

}  // namespace zro
