#pragma once
// The recent past of one quantity, in a term's flat states: what dead time and latency look back
// into, whatever the length of the steps.
#include <cstddef>
#include <span>

namespace zrobench::physics {

/// A view of kDelayStates states: up to 48 pieces of the past, the newest last. Pieces shorter than
/// a 44th of the delay are joined to their neighbour, so that the past always reaches back far
/// enough; equal neighbours are joined, too, at no loss. Before its first piece the past was as
/// that piece begins.
class DelayLine {
 public:
  static constexpr std::size_t kPieces = 48;
  static constexpr std::size_t kStates = 1 + 2 * kPieces;

  explicit DelayLine(std::span<double> states) : states_(states) {}

  void Clear() { states_[0] = 0; }
  /// A quantity that held `value` over a step of `dt_s` > 0, for looking back `delay_s` > 0.
  void AppendHeld(double value, double dt_s, double delay_s);
  /// Its mean over the last step of `dt_s`, as it was `delay_s` ago.
  double MeanOfStep(double dt_s, double delay_s) const;

  /// A quantity that reached `value` at the end of a step, moving in a straight line.
  void AppendPoint(double value, double dt_s, double delay_s);
  /// What it was `delay_s` before now.
  double At(double delay_s) const;

 private:
  std::size_t count() const { return static_cast<std::size_t>(states_[0]); }
  double& value(std::size_t i) const { return states_[1 + 2 * i]; }
  double& duration_s(std::size_t i) const { return states_[2 + 2 * i]; }
  void Push(double value, double dt_s);

  std::span<double> states_;
};

}  // namespace zrobench::physics
