#include "rig/run/judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zrobench {
namespace {

Measurement Value(double value, double uncertainty_k2) {
  return {.name = "m",
          .value = value,
          .unit = "mdps",
          .low = -10,
          .high = 10,
          .uncertainty_k2 = uncertainty_k2};
}

TEST(Judge, PassesOnlyWhenTheUncertaintyStaysInside) {
  EXPECT_EQ(Judge(Value(5, 4)), Verdict::kPass);
  EXPECT_EQ(Judge(Value(5, 6)), Verdict::kMarginal);
  EXPECT_EQ(Judge(Value(-9.5, 1)), Verdict::kMarginal);
}

TEST(Judge, FailsOnlyBeyondTheUncertainty) {
  EXPECT_EQ(Judge(Value(12, 1)), Verdict::kFail);
  EXPECT_EQ(Judge(Value(12, 3)), Verdict::kInconclusive);
  EXPECT_EQ(Judge(Value(-12, 1)), Verdict::kFail);
}

TEST(Judge, ALimitItselfIsInside) {
  EXPECT_EQ(Judge(Value(10, 0)), Verdict::kPass);
  EXPECT_EQ(Judge(Value(std::nextafter(10.0, 11.0), 0)), Verdict::kFail);
}

TEST(Judge, NotANumberIsNoEvidence) {
  EXPECT_EQ(Judge(Value(std::nan(""), 1)), Verdict::kInconclusive);
  EXPECT_EQ(Judge(Value(0, std::nan(""))), Verdict::kInconclusive);
}

TEST(JudgeCheck, NamesTheWorstMeasurement) {
  CheckResult check;
  check.measurements = {Value(1, 0), Value(25, 0), Value(11, 0)};
  check.measurements[1].name = "the_worst";
  JudgeCheck(check);
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_NE(check.reason.find("the_worst"), std::string::npos) << check.reason;
}

TEST(JudgeCheck, NothingMeasuredIsInconclusiveAndSaysSo) {
  CheckResult check;
  JudgeCheck(check);
  EXPECT_EQ(check.verdict, Verdict::kInconclusive);
  EXPECT_FALSE(check.reason.empty());
}

TEST(Worst, OrdersVerdictsFromPassToRigError) {
  EXPECT_EQ(Worst(std::vector{Verdict::kPass, Verdict::kMarginal}), Verdict::kMarginal);
  EXPECT_EQ(Worst(std::vector{Verdict::kFail, Verdict::kInconclusive}), Verdict::kFail);
  EXPECT_EQ(Worst(std::vector{Verdict::kFail, Verdict::kRigError}), Verdict::kRigError);
  EXPECT_EQ(Worst({}), Verdict::kInconclusive);
}

}  // namespace
}  // namespace zrobench
