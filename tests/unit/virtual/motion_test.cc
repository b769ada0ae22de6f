#include "rig/virtual/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace zrobench {
namespace {

struct Peaks {
  double turn_dps = 0, shake_g = 0;
};

Peaks PeaksOf(MotionKind kind, double duration_s) {
  Peaks peaks;
  physics::Inputs inputs;
  for (double t = 0; t <= duration_s; t += 0.001) {
    ApplyMotion(kind, t, duration_s, inputs);
    for (const double rate : inputs.turn_dps)
      peaks.turn_dps = std::max(peaks.turn_dps, std::abs(rate));
    for (const double a : inputs.shake_g) peaks.shake_g = std::max(peaks.shake_g, std::abs(a));
  }
  return peaks;
}

TEST(Motion, AHandSwingsTensOfDegreesPerSecondAndShakes) {
  const Peaks hand = PeaksOf(MotionKind::kHandHeld, 10);
  EXPECT_GT(hand.turn_dps, 20);
  EXPECT_LT(hand.turn_dps, 60);
  EXPECT_GT(hand.shake_g, 0.08);
}

TEST(Motion, ATurnAboutGravityHidesFromTheAccelerometer) {
  const Peaks turn = PeaksOf(MotionKind::kRotate, 10);
  EXPECT_EQ(turn.shake_g, 0);
  EXPECT_NEAR(turn.turn_dps, 0.5, 1e-12);
}

TEST(Motion, FadesInAndOut) {
  physics::Inputs inputs;
  ApplyMotion(MotionKind::kRotate, 0, 10, inputs);
  EXPECT_EQ(inputs.turn_dps[2], 0);
  ApplyMotion(MotionKind::kRotate, 10, 10, inputs);
  EXPECT_EQ(inputs.turn_dps[2], 0);
  ApplyMotion(MotionKind::kRotate, 5, 10, inputs);
  EXPECT_EQ(inputs.turn_dps[2], 0.5);
}

TEST(Motion, OnlyKnownWordsAreMoves) {
  EXPECT_TRUE(ParseMotion("hand_held"));
  EXPECT_FALSE(ParseMotion("dance"));
}

}  // namespace
}  // namespace zrobench
