#include "rig/virtual/plate_controller.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/physics/rig_model.h"

namespace zrobench {
namespace {

/// Plate of the default model under the controller; returns the temperature after `seconds`.
double RunTo(PlateController& controller, physics::RigModel& model, double seconds,
             double* overshoot_degc) {
  for (int i = 0; i < seconds * 10; ++i) {
    physics::Inputs inputs;
    inputs.drive_pct = controller.Step(model.temperatures().plate_degc, 0.1);
    EXPECT_LE(std::abs(inputs.drive_pct), 100);
    model.AdvanceHeat(0.1, inputs);
    *overshoot_degc =
        std::max(*overshoot_degc, model.temperatures().plate_degc - controller.setpoint_degc());
  }
  return model.temperatures().plate_degc;
}

TEST(PlateController, ReachesItsSetPointWithoutWindingUp) {
  auto model = physics::RigModel::Make({}, 200, 1);
  ASSERT_TRUE(model) << model.error().message;
  PlateController controller{VirtualSettings{}};
  controller.Start(60, model->temperatures().plate_degc);
  double overshoot_degc = -100;
  EXPECT_NEAR(RunTo(controller, *model, 900, &overshoot_degc), 60, 0.05);
  EXPECT_LT(overshoot_degc, 2.0);
}

TEST(PlateController, CoolsBelowAmbient) {
  auto model = physics::RigModel::Make({}, 200, 1);
  ASSERT_TRUE(model);
  PlateController controller{VirtualSettings{}};
  controller.Start(5, model->temperatures().plate_degc);
  double overshoot_degc = -100;
  EXPECT_NEAR(RunTo(controller, *model, 900, &overshoot_degc), 5, 0.05);
  EXPECT_LT(controller.drive_pct(), 0);
}

TEST(PlateController, KeepsItsRateLimit) {
  VirtualSettings settings;
  settings.rate_limit_degc_per_min = 3;
  auto model = physics::RigModel::Make({}, 200, 1);
  ASSERT_TRUE(model);
  PlateController controller(settings);
  controller.Start(60, 23);
  double overshoot_degc = -100;
  EXPECT_NEAR(RunTo(controller, *model, 300, &overshoot_degc), 23 + 3 * 5, 1.0);
}

TEST(PlateController, StoppedMeansNoDrive) {
  PlateController controller{VirtualSettings{}};
  controller.Start(60, 23);
  EXPECT_GT(controller.Step(23, 0.1), 0);
  controller.Stop();
  EXPECT_EQ(controller.Step(23, 0.1), 0);
  EXPECT_EQ(controller.drive_pct(), 0);
}

}  // namespace
}  // namespace zrobench
