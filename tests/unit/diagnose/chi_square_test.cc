#include "rig/diagnose/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zrobench::diagnose {
namespace {

TEST(ChiSquare, TailAgreesWithTables) {
  // Upper 5 %, 1 % and 0.1 % points, any table of the distribution.
  EXPECT_NEAR(std::exp(LogChiSquareTail(3.841459, 1)), 0.05, 1e-7);
  EXPECT_NEAR(std::exp(LogChiSquareTail(6.634897, 1)), 0.01, 1e-8);
  EXPECT_NEAR(std::exp(LogChiSquareTail(16.26624, 3)), 0.001, 1e-8);
  EXPECT_NEAR(std::exp(LogChiSquareTail(55.75848, 40)), 0.05, 1e-7);
}

TEST(ChiSquare, TwoDegreesOfFreedomAreAnExponential) {
  for (const double x : {0.1, 1.0, 30.0, 4000.0, 1e6}) {
    EXPECT_NEAR(LogChiSquareTail(x, 2), -x / 2, 1e-9 * x + 1e-12);
  }
}

TEST(ChiSquare, NothingAtZeroAndOneDegreeIsTheErrorFunction) {
  EXPECT_EQ(LogChiSquareTail(0, 3), 0);
  for (const double x : {0.01, 0.5, 2.0, 5.0, 40.0}) {
    EXPECT_NEAR(LogChiSquareTail(x, 1), std::log(std::erfc(std::sqrt(x / 2))), 1e-9);
  }
}

}  // namespace
}  // namespace zrobench::diagnose
