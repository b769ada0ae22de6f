#include "corrector/node/raw_sample.h"

#include <gtest/gtest.h>

namespace zro::node {
namespace {

TEST(RawSample, ScalesByTheRange) {
  RawSample raw{};
  raw.gyro[0] = 16384;
  raw.gyro[1] = -1;
  raw.accel[2] = 8000;
  raw.temperature = -128;
  for (int code = 0; code <= 5; ++code) {
    raw.range_code = static_cast<std::uint8_t>(code);
    const Sample s = ToSample(raw, 0, true);
    EXPECT_EQ(s.rate_dps[0], 62.5f * static_cast<float>(1 << code));
    EXPECT_EQ(s.rate_dps[1], -125.0f * static_cast<float>(1 << code) / 32768.0f);
    EXPECT_EQ(s.accel_g[2], 1.0f);
    EXPECT_EQ(s.temp_degc, -0.5f);
  }
}

TEST(RawSample, EveryGyroWordIsExact) {
  RawSample raw{};
  raw.range_code = 1;
  for (int word = -32768; word <= 32767; ++word) {
    raw.gyro[0] = static_cast<std::int16_t>(word);
    ASSERT_EQ(static_cast<double>(ToSample(raw, 0, true).rate_dps[0]), word * 250.0 / 32768.0);
  }
}

TEST(RawSample, CountsPeriodsAcrossTheWrap) {
  RawSample raw{};
  raw.counter = 2;
  EXPECT_EQ(ToSample(raw, 0xFFFF, false).elapsed, 3u);
  EXPECT_EQ(ToSample(raw, 1, false).elapsed, 1u);
  EXPECT_EQ(ToSample(raw, 9, true).elapsed, 1u) << "first after a boot";
  EXPECT_EQ(ToSample(raw, 2, false).elapsed, 65536u) << "never no time at all";
}

TEST(RawSample, FlagsClippingAndOverrun) {
  RawSample raw{};
  EXPECT_FALSE(ToSample(raw, 0, true).gyro_clipped);
  raw.gyro[2] = 32767;
  EXPECT_TRUE(ToSample(raw, 0, true).gyro_clipped);
  raw.gyro[2] = -32768;
  EXPECT_TRUE(ToSample(raw, 0, true).gyro_clipped);
  raw.gyro[2] = 32766;
  raw.accel_clipped = true;
  raw.overrun = true;
  const Sample s = ToSample(raw, 0, true);
  EXPECT_FALSE(s.gyro_clipped);
  EXPECT_TRUE(s.accel_clipped);
  EXPECT_TRUE(s.overrun);
}

}  // namespace
}  // namespace zro::node
