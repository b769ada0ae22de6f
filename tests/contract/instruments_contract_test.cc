// What every implementation of a role promises (drivers/*/*.h).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/contract/instruments.h"

namespace zrobench {
namespace {

class InstrumentContract : public testing::TestWithParam<Maker> {
 protected:
  std::unique_ptr<InstrumentsUnderTest> bench_ = GetParam().make();
  ThermalPlate& plate_ = bench_->plate();
  Speaker& speaker_ = bench_->speaker();
};

TEST_P(InstrumentContract, ThePlateReadsBackTheSetPointItWasGiven) {
  ASSERT_TRUE(plate_.SetTarget(31.5, bench_->Soon()));
  const auto reading = plate_.Read(bench_->Soon());
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->setpoint_degc, 31.5, 0.05);
  EXPECT_LE(reading->at, bench_->clock().now());
}

TEST_P(InstrumentContract, ThePlateGoesWhereItIsTold) {
  const double before_degc = plate_.Read(bench_->Soon())->process_degc;
  ASSERT_TRUE(plate_.SetTarget(before_degc + 5, bench_->Soon()));
  bench_->Pass(30);
  EXPECT_GT(plate_.Read(bench_->Soon())->process_degc, before_degc + 1);
  EXPECT_GT(plate_.Read(bench_->Soon())->drive_pct, -100.0);
}

TEST_P(InstrumentContract, ARefusedSetPointLeavesTheOldOne) {
  ASSERT_TRUE(plate_.SetTarget(25, bench_->Soon()));
  for (const double impossible :
       {1e6, -1e6, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto refused = plate_.SetTarget(impossible, bench_->Soon());
    ASSERT_FALSE(refused) << impossible;
    EXPECT_EQ(refused.error().kind, Error::Kind::kLimit);
    EXPECT_FALSE(refused.error().message.empty());
  }
  EXPECT_NEAR(plate_.Read(bench_->Soon())->setpoint_degc, 25, 0.05);
}

TEST_P(InstrumentContract, ASafePlateDrivesNothingHoweverOftenItIsMadeSafe) {
  ASSERT_TRUE(plate_.SetTarget(45, bench_->Soon()));
  bench_->Pass(5);
  ASSERT_TRUE(plate_.MakeSafe(bench_->Soon()));
  ASSERT_TRUE(plate_.MakeSafe(bench_->Soon()));
  bench_->Pass(5);
  EXPECT_EQ(plate_.Read(bench_->Soon())->drive_pct, 0);
}

TEST_P(InstrumentContract, TheSpeakerReadsBackItsTone) {
  ASSERT_TRUE(speaker_.SetTone(1000, 0.5, bench_->Soon()));
  const auto state = speaker_.Read(bench_->Soon());
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->hz, 1000, 0.1);
  EXPECT_NEAR(state->v, 0.5, 0.005);
  EXPECT_TRUE(state->on);
}

TEST_P(InstrumentContract, AMutedSpeakerIsSilentHoweverOftenItIsMuted) {
  ASSERT_TRUE(speaker_.SetTone(1000, 0.5, bench_->Soon()));
  ASSERT_TRUE(speaker_.Mute(bench_->Soon()));
  ASSERT_TRUE(speaker_.Mute(bench_->Soon()));
  EXPECT_FALSE(speaker_.Read(bench_->Soon())->on);
  EXPECT_EQ(speaker_.Read(bench_->Soon())->v, 0);
}

TEST_P(InstrumentContract, ARefusedToneChangesNothing) {
  ASSERT_TRUE(speaker_.SetTone(1000, 0.5, bench_->Soon()));
  for (const double hz : {0.0, -5.0, 1e9, std::nan("")}) {
    EXPECT_FALSE(speaker_.SetTone(hz, 0.5, bench_->Soon())) << hz;
  }
  EXPECT_FALSE(speaker_.SetTone(1000, 1e3, bench_->Soon()));
  EXPECT_FALSE(speaker_.SetTone(1000, std::nan(""), bench_->Soon()));
  EXPECT_NEAR(speaker_.Read(bench_->Soon())->hz, 1000, 0.1);
  EXPECT_NEAR(speaker_.Read(bench_->Soon())->v, 0.5, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Every, InstrumentContract,
                         testing::Values(Maker{"virtual_rig", MakeVirtualInstruments}),
                         [](const auto& maker) { return maker.param.name; });

}  // namespace
}  // namespace zrobench
