// Every code a corrector can give, reached through its face. 12 (supply) has no input here.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using test::Bench;
using test::Scene;

constexpr std::uint16_t kToday = 15000;

struct Case {
  Code code;
  std::function<void(Bench&)> reach;
};

void PrintTo(const Case& c, std::ostream* out) { *out << "code " << static_cast<int>(c.code); }

void Spoil(Bench& bench, const std::function<void(int, Sample*)>& touch) {
  for (int i = 0; i < 7 * 200; ++i) {
    Sample s = bench.Make(Scene{});
    touch(i, &s);
    bench.Step(s);
  }
}
void Noisy(Bench& bench, double factor) {
  bench.Rest(7.0);
  bench.Run(12.0, [factor](double) { return Scene{25.0, {0, 0, 0}, factor, false}; });
}
void OneStill(Bench& bench, double shift_dps) {
  bench.Rest(7.0, 25.0, {shift_dps, 0.0, 0.0});
  bench.Shake(1.0);
}
void Cover(Bench& bench) {  // every bin of the coverage
  for (double temp = 1.0; temp < 50.0; temp += 2.5) {
    bench.Rest(7.0, temp);
    bench.Shake(1.0, temp);
  }
}

const Case kCases[] = {
    {Code::kMotion, [](Bench& b) { b.Rest(7.0), b.Shake(1.0); }},
    {Code::kGyroVariance, [](Bench& b) { Noisy(b, 4.0); }},
    {Code::kBiasLimit,
     [](Bench& b) {
       b.Rest(7.0, 25.0, {13.0, 0.0, 0.0});
     }},
    {Code::kDiffersFromEntry, [](Bench& b) { OneStill(b, 0.0), OneStill(b, 2.0); }},
    {Code::kTemperatureSlope,
     [](Bench& b) { b.Run(7.0, [](double t) { return Scene{25.0 + 0.2 * t}; }); }},
    {Code::kTemperatureRange, [](Bench& b) { b.Rest(7.0, 90.0); }},
    {Code::kTemperatureSensor,
     [](Bench& b) { Spoil(b, [](int, Sample* s) { s->temp_degc = NAN; }); }},
    {Code::kTooShort, [](Bench& b) { b.Rest(4.0), b.Shake(1.0); }},
    {Code::kClipped,
     [](Bench& b) { Spoil(b, [](int i, Sample* s) { s->gyro_clipped = i == 400; }); }},
    {Code::kAcousticOrVibration, [](Bench& b) { Noisy(b, 1.8); }},
    {Code::kSampleGap, [](Bench& b) { Spoil(b, [](int i, Sample* s) { s->overrun = i == 400; }); }},
    {Code::kStoreInvalid,
     [](Bench& b) {
       b.storage.slots[0][3] = 7;
       b.corrector().Boot();
       b.Rest(0.1);
     }},
    {Code::kStoreWrite, [](Bench& b) { b.storage.fail_writes = true, b.Rest(8.0); }},
    {Code::kDiffersFromEstimate,
     [](Bench& b) {
       b.AddFactory({10, 40}), b.Rest(30.0, 25.0, {0.5, 0.0, 0.0});
     }},
    {Code::kTestMode, [](Bench& b) { b.corrector().SetTestMode(true), b.Rest(7.0); }},
    {Code::kNew, [](Bench& b) { b.Rest(7.0); }},
    {Code::kMerged, [](Bench& b) { OneStill(b, 0.0), OneStill(b, 0.02); }},
    {Code::kOverwroteOld,
     [](Bench& b) {
       OneStill(b, 0.0);
       b.corrector().SetDate(kToday + 40);
       OneStill(b, 0.0);
     }},
    {Code::kRecentNothingToDo, [](Bench& b) { b.Rest(15.0); }},
    {Code::kQuarantined, [](Bench& b) { OneStill(b, 0.0), OneStill(b, 2.0); }},
    {Code::kShiftConfirmed, [](Bench& b) { OneStill(b, 2.0), OneStill(b, 0.0), OneStill(b, 0.0); }},
    {Code::kQuarantineExpired,
     [](Bench& b) { OneStill(b, 0.0), OneStill(b, 2.0), OneStill(b, 0.0); }},
    {Code::kRetry, [](Bench& b) { OneStill(b, 0.0), OneStill(b, 2.0); }},
    {Code::kTableComplete, [](Bench& b) { Cover(b); }},
    {Code::kReArmed, [](Bench& b) { Cover(b), b.corrector().SetDate(kToday + 40), b.Rest(0.1); }},
};

class Codes : public testing::TestWithParam<Case> {};

TEST_P(Codes, IsReachedWithTheAxisAndBinOfItsReading) {
  Bench bench;
  bench.corrector().SetDate(kToday);
  GetParam().reach(bench);
  EXPECT_GE(bench.Count(GetParam().code), 1);
  std::uint32_t seq = 0;
  for (const Event& e : bench.events) {
    EXPECT_EQ(e.seq, seq++);
    EXPECT_LE(e.axis, kNoAxis);
    EXPECT_LE(e.bin, kNoBin);
    EXPECT_TRUE(std::isfinite(e.value) && std::isfinite(e.limit) && std::isfinite(e.temp_degc));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Codes, testing::ValuesIn(kCases), [](const auto& one) {
  return "Code" + std::to_string(static_cast<int>(one.param.code));
});

TEST(CodeList, HasEveryCodeButSupply) {
  std::set<int> listed;
  for (const Case& c : kCases) listed.insert(static_cast<int>(c.code));
  std::set<int> all;
  for (int code = 1; code <= 16; ++code) all.insert(code);
  for (int code = 32; code <= 41; ++code) all.insert(code);
  all.erase(static_cast<int>(Code::kSupply));
  EXPECT_EQ(listed, all);
}

}  // namespace
}  // namespace zro
