#include "rig/physics/rig_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rig/physics/signal.h"
#include "tests/unit/physics/spectrum.h"

namespace zrobench::physics {
namespace {

RigModel Rig(const Model& model, std::uint64_t seed = 1) {
  return RigModel::Make(model, 200, seed).value();
}

bool SameBits(const Sensed& a, const Sensed& b) {
  return a.rate_dps == b.rate_dps && a.accel_g == b.accel_g;
}

TEST(RigModel, RefusesAnImpossibleModel) {
  Model model;
  model.plate.heat_capacity_j_per_k = -3;
  const auto rig = RigModel::Make(model, 200, 1);
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().kind, Error::Kind::kConfig);
  EXPECT_THAT(rig.error().message, testing::HasSubstr("model.plate.heat_capacity_j_per_k"));
  for (const double sample_hz : {0.0, -1.0, std::nan("")}) {
    EXPECT_FALSE(RigModel::Make(Model{}, sample_hz, 1)) << sample_hz;
  }
}

TEST(RigModel, SameSeedSameBitsOtherSeedOtherNumbers) {
  RigModel a = Rig({}, 42), b = Rig({}, 42), c = Rig({}, 43);
  for (int i = 0; i < 5000; ++i) {
    const Sensed from_a = a.SampleSensors({}), from_b = b.SampleSensors({});
    const Sensed from_c = c.SampleSensors({});
    ASSERT_TRUE(SameBits(from_a, from_b));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_NE(from_a.rate_dps[axis], from_c.rate_dps[axis]);
      ASSERT_NE(from_a.accel_g[axis], from_c.accel_g[axis]);
    }
  }
}

TEST(RigModel, WholeRigHasTheSameBitsInEveryBuild) {
  Model model;
  model.terms = {"acoustic.resonance", "acoustic.rectification"};
  RigModel rig = Rig(model, 7);
  Inputs inputs;
  inputs.drive_pct = 40;
  inputs.tone_hz = 27000;
  inputs.tone_pa = 1;
  double sum = 0;
  for (int i = 0; i < 20000; ++i) {
    rig.AdvanceHeat(0.005, inputs);
    const Sensed sensed = rig.SampleSensors(inputs);
    sum += sensed.rate_dps[0] + sensed.rate_dps[2] + sensed.accel_g[1];
  }
  EXPECT_EQ(sum, 0x1.b3f075cf4ce9cp+14);
}

TEST(RigModel, ZeroCoefficientsEqualTheBaseModelBitByBit) {
  Model with;
  with.terms = {"acoustic.resonance", "acoustic.rectification"};
  with.term["acoustic.resonance"]["injection_dps_per_pa"] = {0, 0, 0};
  with.term["acoustic.rectification"]["dps_per_pa2"] = {0, 0, 0};
  RigModel base = Rig({}), nested = Rig(with);
  Inputs inputs;
  inputs.tone_hz = 27000;
  inputs.tone_pa = 2;
  inputs.drive_pct = 30;
  for (int i = 0; i < 5000; ++i) {
    base.AdvanceHeat(0.005, inputs);
    nested.AdvanceHeat(0.005, inputs);
    ASSERT_TRUE(SameBits(base.SampleSensors(inputs), nested.SampleSensors(inputs)));
  }
}

TEST(RigModel, ATermThatIsOffChangesNothing) {
  Model stated;  // parameters in the file, but not in `terms`
  stated.term["acoustic.rectification"]["dps_per_pa2"] = {9, 9, 9};
  RigModel base = Rig({}), off = Rig(stated);
  Inputs inputs;
  inputs.tone_hz = 27000;
  inputs.tone_pa = 2;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(SameBits(base.SampleSensors(inputs), off.SampleSensors(inputs)));
  }
}

TEST(RigModel, OffsetIsTheCubicAtTheDie) {
  Model model;
  model.gyro->noise_density_dps_per_rthz = 0;
  model.gyro->flicker_dps = 0;
  RigModel rig = Rig(model);
  Inputs inputs;
  inputs.drive_pct = 60;
  rig.AdvanceHeat(150, inputs);
  const double x = rig.temperatures().die_degc - 25;
  ASSERT_GT(x, 10);
  const Axes rate_dps = rig.SampleSensors(inputs).rate_dps;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& c = model.gyro->zro_dps[axis];
    EXPECT_NEAR(rate_dps[axis], c[0] + c[1] * x + c[2] * x * x + c[3] * x * x * x, 1e-12);
    EXPECT_EQ(rate_dps[axis], rig.TrueZro()[axis]);
  }
  EXPECT_DOUBLE_EQ(CubicOffset(*model.gyro, 25)[0], 0.8);
}

TEST(RigModel, TrueZroKnowsNeitherNoiseNorSoundNorMotion) {
  Model model;
  model.terms = {"acoustic.resonance", "acoustic.rectification"};
  RigModel rig = Rig(model);
  const Axes before = rig.TrueZro();
  Inputs inputs;
  inputs.tone_hz = 27000;
  inputs.tone_pa = 5;
  inputs.turn_dps = {10, 20, 30};
  rig.AdvanceHeat(1, inputs);
  rig.SampleSensors(inputs);
  EXPECT_EQ(rig.TrueZro(), before);
}

TEST(RigModel, MotionAndGravityReachTheSensors) {
  Model model;
  model.gyro = GyroModel{25, 0, 0, {}};
  model.accel.noise_density_g_per_rthz = 0;
  Inputs inputs;
  inputs.turn_dps = {10, -20, 30};
  inputs.shake_g = {0.1, 0.2, -0.3};
  inputs.gravity_g = {0, 1, 0};
  const Sensed sensed = Rig(model).SampleSensors(inputs);
  EXPECT_EQ(sensed.rate_dps, (Axes{10, -20, 30}));
  EXPECT_EQ(sensed.accel_g, (Axes{0.1, 1.2, -0.3}));
}

TEST(RigModel, NoiseHasItsSizeOnEveryAxis) {
  Model model;
  model.gyro->flicker_dps = 0;
  RigModel rig = Rig(model);
  constexpr int kN = 200000;
  const Axes offset_dps = rig.TrueZro();
  Axes rate2{}, accel2{};
  double cross = 0, gyro_accel = 0;
  for (int i = 0; i < kN; ++i) {
    const Sensed s = rig.SampleSensors({});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rate2[axis] += std::pow(s.rate_dps[axis] - offset_dps[axis], 2) / kN;
      accel2[axis] += std::pow(s.accel_g[axis] - (axis == 2 ? 1 : 0), 2) / kN;
    }
    cross += (s.rate_dps[0] - offset_dps[0]) * (s.rate_dps[1] - offset_dps[1]) / kN;
    gyro_accel += (s.rate_dps[0] - offset_dps[0]) * s.accel_g[0] / kN;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(rate2[axis]) / (0.005 * 10), 1, 0.01);
    EXPECT_NEAR(std::sqrt(accel2[axis]) / (1e-4 * 10), 1, 0.01);
  }
  EXPECT_NEAR(cross / (0.05 * 0.05), 0, 0.01);
  EXPECT_NEAR(gyro_accel / (0.05 * 1e-3), 0, 0.01);
}

TEST(RigModel, FlickerOfTheModelReachesTheGyro) {
  Model model;
  model.gyro->noise_density_dps_per_rthz = 0;
  model.gyro->flicker_dps = 0.01;
  RigModel rig = Rig(model);
  std::vector<double> x(1 << 20);
  for (double& value : x) value = rig.SampleSensors({}).rate_dps[1];
  const double floor_dps = 0.01 * std::sqrt(std::numbers::ln2 / std::numbers::pi);
  EXPECT_NEAR(AllanDeviation(x, 200) / floor_dps, 1, 0.05);
}

TEST(RigModel, WithoutAGyroItsChannelsAreZero) {
  Model model;
  model.gyro.reset();
  model.terms = {"acoustic.rectification"};
  RigModel rig = Rig(model);
  Inputs inputs;
  inputs.tone_hz = 27000;
  inputs.tone_pa = 2;
  inputs.turn_dps = {1, 1, 1};
  EXPECT_EQ(rig.SampleSensors(inputs).rate_dps, (Axes{}));
  EXPECT_EQ(rig.TrueZro(), (Axes{}));
}

TEST(RigModel, EnergyBalances) {
  RigModel rig = Rig({});
  Inputs inputs;
  inputs.drive_pct = -70;
  inputs.load_w = 0.5;
  double flowed_j = 0;
  for (int i = 0; i < 20000; ++i) {  // midpoint rule at 10 ms: error (dt/tau)^2 / 24, 1e-7
    rig.AdvanceHeat(0.005, inputs);
    flowed_j += 0.01 * rig.NetHeatFlow();
    rig.AdvanceHeat(0.005, inputs);
  }
  EXPECT_LT(flowed_j, -3000);
  EXPECT_NEAR(rig.StoredHeat() / flowed_j, 1, 1e-8);
}

TEST(RigModel, TheBoardsLoadWarmsTheDieAboveThePlate) {
  RigModel rig = Rig({});
  Inputs inputs;
  inputs.load_w = 0.4;
  rig.AdvanceHeat(60, inputs);
  const Temperatures t = rig.temperatures();
  EXPECT_GT(t.die_degc, t.plate_degc + 0.4);
}

TEST(RigModel, ResetBringsBackAmbient) {
  RigModel rig = Rig({});
  Inputs inputs;
  inputs.drive_pct = 100;
  rig.AdvanceHeat(100, inputs);
  ASSERT_GT(rig.temperatures().die_degc, 30);
  rig.Reset();
  EXPECT_EQ(rig.temperatures().plate_degc, 23);
  EXPECT_EQ(rig.temperatures().board_degc, 23);
  EXPECT_EQ(rig.temperatures().die_degc, 23);
  EXPECT_EQ(rig.StoredHeat(), 0);
}

}  // namespace
}  // namespace zrobench::physics
