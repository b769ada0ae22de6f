#include "rig/profile/plan.h"

#include <gtest/gtest.h>

namespace zrobench {
namespace {

TEST(Plan, RampsTakeTheirRateHoldsTheirTime) {
  Profile p;
  p.steps = {{Ramp{40, 2}, {}, 1},
             {Hold{30}, {}, 2},
             {Tone{1000, 1, 94, 5}, {}, 3},
             {Move{"tap", 4}, {}, 4}};
  EXPECT_DOUBLE_EQ(NominalDurationS(p, 20), 600 + 30 + 5 + 4);
}

TEST(Plan, EveryStepStartsWhereTheLastEnded) {
  Profile p;
  p.steps = {{Ramp{40, 10}, {}, 1}, {Ramp{20, 10}, {}, 2}, {Ramp{20, 10}, {}, 3}};
  EXPECT_DOUBLE_EQ(NominalDurationS(p, 20), 120 + 120 + 0);
}

TEST(Plan, ASoakTakesTheWayThereAndItsHold) {
  Profile p;
  p.steps = {{Soak{30, 45, 0.3}, {}, 1}};
  EXPECT_GT(NominalDurationS(p, 20), NominalDurationS(p, 29) + 10);
  EXPECT_DOUBLE_EQ(NominalDurationS(p, 30), 45 + 20);  // at rest: the settle window alone
}

TEST(Plan, ASoakAfterARampSettlesLongerThanOneAtRest) {
  Profile at_rest, after_ramp;
  at_rest.steps = {{Soak{42, 45, 0.3}, {}, 1}};
  after_ramp.steps = {{Ramp{42, 10}, {}, 1}, {Soak{42, 45, 0.3}, {}, 2}};
  EXPECT_GT(NominalDurationS(after_ramp, 32), 60 + NominalDurationS(at_rest, 42) + 20);
}

TEST(Plan, StimuliRunBesideTheirStep) {
  Profile p;
  p.steps = {{Hold{60}, {{Tone{1000, 1, 94, 20}, 5.0, {}}}, 1}};
  EXPECT_DOUBLE_EQ(NominalDurationS(p, 20), 60);
}

}  // namespace
}  // namespace zrobench
