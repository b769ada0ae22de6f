#pragma once
// A node with the storage and the bus a test can look into.
#include <cstring>
#include <vector>

#include "corrector/node/node.h"

namespace zro::node {

class RamStorage final : public Storage {
 public:
  bool Read(int slot, std::uint8_t* out, std::size_t size) override {
    slots[slot].resize(size, 0xFF);  // erased flash
    std::memcpy(out, slots[slot].data(), size);
    return true;
  }
  bool Write(int slot, const std::uint8_t* data, std::size_t size) override {
    if (broken) return false;
    slots[slot].assign(data, data + size);
    return true;
  }
  std::vector<std::uint8_t> slots[kSlots];
  bool broken = false;
};

class RecordingSink final : public FrameSink {
 public:
  void Send(const Frame& frame) override { frames.push_back(frame); }
  /// All messages of one kind, in order.
  template <typename M>
  std::vector<M> All() const {
    std::vector<M> found;
    M m{};
    for (const Frame& f : frames) {
      if (Decode(f, &m)) found.push_back(m);
    }
    return found;
  }
  std::vector<Frame> frames;
};

inline constexpr Identity kTestIdentity{1, 12, 103, 4, 0xCAFEF00D, 0x00012345};

/// A board at rest: gravity on z, 20 degC, gyro at `gyro` LSB (250 dps range) with a little noise.
struct Board {
  explicit Board(RamStorage* use = nullptr, const Config& config = ConfigFor(200.0f, 0.005f))
      : node(kTestIdentity, config, use != nullptr ? use : &storage, &sink) {}

  RawSample Next() {
    ++counter;
    noise = noise * 1664525u + 1013904223u;
    const auto wobble = static_cast<std::int16_t>(static_cast<int>(noise >> 24) % 9 - 4);
    RawSample raw{};
    for (int i = 0; i < kAxes; ++i) raw.gyro[i] = static_cast<std::int16_t>(gyro + wobble);
    raw.accel[2] = static_cast<std::int16_t>(8000 + wobble);
    raw.temperature = temperature;
    raw.counter = counter;
    raw.range_code = 1;
    return raw;
  }
  void Run(int samples) {
    for (int i = 0; i < samples; ++i) node.OnSample(Next());
  }
  /// Sends an expedited download (1..4 bytes) and returns the answer.
  SdoMsg Write(std::uint16_t index, std::uint8_t sub, std::uint32_t value, int bytes) {
    const auto command = static_cast<std::uint8_t>(0x23 | (4 - bytes) << 2);
    return Ask(SdoMsg{SdoMsg::kRxId, command, index, sub, value});
  }
  SdoMsg Read(std::uint16_t index, std::uint8_t sub) {
    return Ask(SdoMsg{SdoMsg::kRxId, 0x40, index, sub, 0});
  }
  SdoMsg Ask(const SdoMsg& request) {
    const std::size_t before = sink.frames.size();
    node.OnFrame(Encode(request));
    SdoMsg reply{};
    if (before < sink.frames.size()) Decode(sink.frames[before], &reply);
    return reply;
  }

  RamStorage storage;
  RecordingSink sink;
  Node node;
  std::uint16_t counter = 0;
  std::int16_t gyro = 20;
  std::int16_t temperature = 20 * 256;
  std::uint32_t noise = 1;
};

}  // namespace zro::node
