#include "rig/physics/sensor_word.h"

#include <gtest/gtest.h>

#include <limits>

namespace zrobench::physics {
namespace {

void ExpectWord(double value, double lsb, int word, bool clipped) {
  const SensorWord got = QuantiseToWord(value, lsb);
  EXPECT_EQ(got.word, word) << value << " in steps of " << lsb;
  EXPECT_EQ(got.clipped, clipped) << value << " in steps of " << lsb;
}

TEST(SensorWord, RoundsToNearest) {
  ExpectWord(0, 0.5, 0, false);
  ExpectWord(1.24, 0.5, 2, false);
  ExpectWord(1.26, 0.5, 3, false);
  ExpectWord(-1.24, 0.5, -2, false);
  ExpectWord(-1.26, 0.5, -3, false);
  ExpectWord(0.25, 0.5, 1, false);
  ExpectWord(-0.25, 0.5, -1, false);
}

TEST(SensorWord, SaturatesAndSaysSo) {
  const double lsb = 250.0 / 32768;
  ExpectWord(32767 * lsb, lsb, 32767, false);
  ExpectWord(32767.4 * lsb, lsb, 32767, false);
  ExpectWord(32767.6 * lsb, lsb, 32767, true);
  ExpectWord(-32768.4 * lsb, lsb, -32768, false);
  ExpectWord(-32768.6 * lsb, lsb, -32768, true);
  ExpectWord(1e30, lsb, 32767, true);
  ExpectWord(-std::numeric_limits<double>::infinity(), lsb, -32768, true);
  ExpectWord(std::numeric_limits<double>::quiet_NaN(), lsb, 0, true);
}

TEST(SensorWord, NoStepIsABug) { EXPECT_THROW(QuantiseToWord(1, 0), std::logic_error); }

TEST(Quantise, GivesTheNearestMultiple) {
  EXPECT_DOUBLE_EQ(Quantise(23.04, 0.1), 23.0);
  EXPECT_DOUBLE_EQ(Quantise(23.06, 0.1), 23.1);
  EXPECT_DOUBLE_EQ(Quantise(-5.06, 0.1), -5.1);
  EXPECT_EQ(Quantise(25.1230, 0.00390625), 25.12109375);
  EXPECT_EQ(Quantise(23.0456, 0), 23.0456);
}

}  // namespace
}  // namespace zrobench::physics
