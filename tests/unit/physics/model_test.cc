#include "rig/physics/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace zrobench::physics {
namespace {

using testing::HasSubstr;

std::string Complaint(const std::function<void(Model&)>& spoil) {
  Model model;
  spoil(model);
  const Status status = Validate(model);
  if (status) return "";
  EXPECT_EQ(status.error().kind, Error::Kind::kConfig);
  return status.error().message;
}

TEST(Validate, DefaultsAndAbsentPartsAreFine) {
  EXPECT_EQ(Complaint([](Model&) {}), "");
  EXPECT_EQ(Complaint([](Model& m) {
              m.board.reset();
              m.package.reset();
              m.gyro.reset();
            }),
            "");
  EXPECT_EQ(Complaint([](Model& m) {
              m.terms = {"acoustic.resonance", "acoustic.rectification"};
              m.term["acoustic.resonance"]["q"] = {100};
            }),
            "");
}

TEST(Validate, NamesKeyBoundAndValue) {
  EXPECT_EQ(Complaint([](Model& m) { m.plate.heat_capacity_j_per_k = -3; }),
            "model.plate.heat_capacity_j_per_k must be > 0, is -3");
  EXPECT_EQ(Complaint([](Model& m) { m.board->heat_capacity_j_per_k = 0; }),
            "model.board.heat_capacity_j_per_k must be > 0, is 0");
  EXPECT_EQ(Complaint([](Model& m) { m.package->time_constant_s = 0; }),
            "model.package.time_constant_s must be > 0, is 0");
  EXPECT_EQ(Complaint([](Model& m) { m.board->to_plate_w_per_k = -0.1; }),
            "model.board.to_plate_w_per_k must be >= 0, is -0.1");
  EXPECT_EQ(Complaint([](Model& m) { m.gyro->flicker_dps = -1; }),
            "model.gyro.flicker_dps must be >= 0, is -1");
  EXPECT_EQ(Complaint([](Model& m) { m.gyro->zro_dps[1][2] = std::nan(""); }),
            "model.gyro.zro_y_dps must be finite, is nan");
  EXPECT_EQ(Complaint([](Model& m) { m.ambient_degc = -300; }),
            "model.ambient.degc must be above absolute zero, is -300");
  EXPECT_EQ(Complaint([](Model& m) { m.speaker.pa_per_v = 0; }),
            "model.speaker.pa_per_v must be > 0, is 0");
}

TEST(Validate, UnknownTermGetsTheNearestKnownOne) {
  EXPECT_EQ(Complaint([](Model& m) { m.terms = {"acoustic.rectificaton"}; }),
            "model.terms names the unknown term \"acoustic.rectificaton\"; nearest is "
            "\"acoustic.rectification\"");
  EXPECT_THAT(Complaint([](Model& m) { m.term["acoustic.resonnance"] = {}; }),
              HasSubstr("nearest is \"acoustic.resonance\""));
  EXPECT_EQ(Complaint([](Model& m) {
              m.terms = {"acoustic.resonance", "acoustic.resonance"};
            }),
            "model.terms names \"acoustic.resonance\" twice");
}

TEST(Validate, ParametersOfTermsAreCheckedEvenWhenTheTermIsOff) {
  EXPECT_EQ(Complaint([](Model& m) {
              m.term["acoustic.rectification"]["dps_per_pa"] = {1, 1, 1};
            }),
            "model.term.\"acoustic.rectification\".dps_per_pa is no parameter of this term; it has "
            "dps_per_pa2");
  EXPECT_EQ(Complaint([](Model& m) { m.term["acoustic.resonance"]["resonance_hz"] = {27000}; }),
            "model.term.\"acoustic.resonance\".resonance_hz must hold 3 values, holds 1");
  EXPECT_EQ(Complaint([](Model& m) {
              m.term["acoustic.resonance"]["q"] = {1, 2};
            }),
            "model.term.\"acoustic.resonance\".q must hold 1 value, holds 2");
  EXPECT_EQ(Complaint([](Model& m) { m.term["acoustic.resonance"]["q"] = {0}; }),
            "model.term.\"acoustic.resonance\".q must be > 0, is 0");
  EXPECT_EQ(Complaint([](Model& m) {
              m.term["acoustic.resonance"]["injection_dps_per_pa"] = {1, INFINITY, 1};
            }),
            "model.term.\"acoustic.resonance\".injection_dps_per_pa must be finite, is inf");
}

TEST(Validate, TellsEverythingAtOnceWithItsKey) {
  Model model;
  model.plate.heater_w = -1;
  model.accel.noise_density_g_per_rthz = -1;
  const auto errors = FindErrors(model);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[0].key, "model.plate.heater_w");
  EXPECT_EQ(errors[1].key, "model.accel.noise_density_g_per_rthz");
  EXPECT_EQ(Validate(model).error().message, errors[0].message + "\n" + errors[1].message);
}

}  // namespace
}  // namespace zrobench::physics
