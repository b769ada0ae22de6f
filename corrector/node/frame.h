#pragma once
#include <cstdint>

namespace zro::node {

/// A classic CAN data frame with an 11-bit id.
struct Frame {
  std::uint32_t id;
  std::uint8_t dlc;
  std::uint8_t data[8];
};

/// Where the node's frames go; called in bus order.
class FrameSink {
 public:
  virtual void Send(const Frame& frame) = 0;

 protected:
  ~FrameSink() = default;
};

}  // namespace zro::node
