#pragma once
#include <optional>
#include <vector>

#include "drivers/link/can_bus.h"

namespace zrobench {

/// A bus whose peer is written by the test: each request is answered by the next scripted frame.
class ScriptedBus final : public CanBus {
 public:
  bool ready() const override { return !waiting_.empty(); }
  std::optional<CanFrame> Receive() override {
    if (waiting_.empty()) return std::nullopt;
    const CanFrame frame = waiting_.front();
    waiting_.erase(waiting_.begin());
    return frame;
  }
  Status Send(const zro::node::Frame& frame) override {
    sent.push_back(frame);
    if (answers.empty()) return {};
    for (const zro::node::Frame& answer : answers.front()) waiting_.push_back({answer, {}, false});
    answers.erase(answers.begin());
    return {};
  }
  CanHealth health() const override { return state; }
  void Show(const CanFrame& frame) { waiting_.push_back(frame); }

  std::vector<std::vector<zro::node::Frame>> answers;  ///< to the first, second, ... request
  std::vector<zro::node::Frame> sent;
  CanHealth state;

 private:
  std::vector<CanFrame> waiting_;
};

}  // namespace zrobench
