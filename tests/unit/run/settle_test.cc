#include "rig/run/settle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zrobench {
namespace {

Instant At(double s) { return Instant(FromSeconds(s)); }

/// First second at which the detector says settled, or -1.
template <typename Process, typename Board>
int SettledAfter(const SettleCriterion& criterion, Process process, Board board) {
  SettleDetector detector(criterion, 40, At(0));
  for (int s = 0; s < 600; ++s) {
    detector.Add(At(s), process(s), board(s));
    if (detector.settled()) return s;
  }
  return -1;
}

const SettleCriterion kCriterion{.band_degc = 0.3, .slope_degc_per_min = 0.5, .window_s = 20};

TEST(Settle, NeedsTheBandForTheWholeWindow) {
  const auto steady = [](int) { return 40.0; };
  EXPECT_EQ(SettledAfter(kCriterion, steady, steady), 20);
  const auto one_excursion = [](int s) { return s == 15 ? 40.5 : 40.0; };
  EXPECT_EQ(SettledAfter(kCriterion, one_excursion, steady), 36);
}

TEST(Settle, WaitsForTheBoardThatLagsBehindThePlate) {
  // The board follows with 60 s: its slope falls below 0.5 degC/min when 20/60 * exp(-t/60) does.
  const auto plate = [](int) { return 40.0; };
  const auto board = [](int s) { return 40.0 - 20.0 * std::exp(-s / 60.0); };
  const int settled = SettledAfter(kCriterion, plate, board);
  const double expected = 60 * std::log(20.0 / 60 * 60 / 0.5) + 10;  // + half the window
  EXPECT_NEAR(settled, expected, 3);
}

TEST(Settle, NeverSettlesOutsideTheBand) {
  const auto off = [](int) { return 40.31; };
  const auto board = [](int) { return 40.0; };
  EXPECT_EQ(SettledAfter(kCriterion, off, board), -1);
}

TEST(Settle, ASilentBoardLeavesTheBandAlone) {
  const auto plate = [](int) { return 40.0; };
  const auto silent = [](int) -> std::optional<double> { return std::nullopt; };
  EXPECT_EQ(SettledAfter(kCriterion, plate, silent), 20);
}

TEST(Settle, TimesOut) {
  SettleDetector detector({.timeout_s = 100}, 40, At(50));
  EXPECT_FALSE(detector.timed_out(At(150)));
  EXPECT_TRUE(detector.timed_out(At(150.1)));
}

}  // namespace
}  // namespace zrobench
