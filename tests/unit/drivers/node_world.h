#pragma once
// A board on a MemoryBus that lives in virtual time: what a client test talks to.
#include <cstring>
#include <vector>

#include "core/clock.h"
#include "corrector/node/node.h"
#include "drivers/link/memory_bus.h"

namespace zrobench {

/// Runs a node every millisecond: frames first, then time, and a sample each 5 ms.
class NodeWorld final : public Simulation {
 public:
  explicit NodeWorld(VirtualClock* clock) : bus(*clock) {
    clock->Attach(this);
    PowerOn();
  }

  Instant next_event() const override { return next_; }
  void Run(Instant) override {
    next_ += std::chrono::milliseconds(1);
    ++ms_;
    while (const std::optional<zro::node::Frame> frame = bus.BoardReceive()) {
      if (!silent) node->OnFrame(*frame);
    }
    if (silent) return;
    node->OnTime(ms_);
    if (ms_ % 5 == 0) node->OnSample(Sample());
  }
  /// A new life of the board over the same storage.
  void PowerOn() {
    node.emplace(kIdentity, zro::ConfigFor(200.0f, 0.005f), &storage_, &bus.board_sink());
    ms_ = 0;
    counter_ = 0;
    node->Boot(zro::node::BootReason::kPowerOn, ++boots_);
  }

  MemoryBus bus;
  std::optional<zro::node::Node> node;
  bool silent = false;  ///< unpowered: neither hears nor speaks
  bool shaken = false;  ///< half a second of every four

 private:
  static constexpr zro::node::Identity kIdentity{1, 0, 0, 1, 2, 3};

  class Ram final : public zro::Storage {
   public:
    bool Read(int slot, std::uint8_t* out, std::size_t size) override {
      slots_[slot].resize(size, 0xFF);
      std::memcpy(out, slots_[slot].data(), size);
      return true;
    }
    bool Write(int slot, const std::uint8_t* bytes, std::size_t size) override {
      slots_[slot].assign(bytes, bytes + size);
      return true;
    }

   private:
    std::vector<std::uint8_t> slots_[kSlots];
  };

  zro::node::RawSample Sample() {
    zro::node::RawSample raw{};
    noise_ = noise_ * 1664525u + 1013904223u;
    const int wobble = static_cast<int>(noise_ >> 24) % 9 - 4;
    for (std::int16_t& gyro : raw.gyro) gyro = static_cast<std::int16_t>(20 + wobble);
    raw.accel[2] = static_cast<std::int16_t>(8000 + wobble);
    if (shaken && ms_ % 4000 < 500)
      raw.accel[0] = static_cast<std::int16_t>(ms_ % 10 ? 3000 : -3000);
    raw.temperature = 20 * 256;
    raw.counter = ++counter_;
    raw.range_code = 1;
    return raw;
  }

  Ram storage_;
  Instant next_{};
  std::uint32_t ms_ = 0;
  std::uint16_t counter_ = 0;
  std::uint16_t boots_ = 0;
  std::uint32_t noise_ = 1;
};

}  // namespace zrobench
