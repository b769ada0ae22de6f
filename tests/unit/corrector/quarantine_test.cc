#include "corrector/quarantine.h"

#include <gtest/gtest.h>

#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using test::Bench;
using test::Scene;
using test::Vector;
using Verdict = Quarantine::Verdict;

constexpr float kHz = 10.0f;
Quarantine::Vote VoteAt(float minute, float shift_dps, bool lone = false) {
  return {{shift_dps, 0.0f, 0.0f},
          0.003f,
          0.05f,
          static_cast<std::uint32_t>(minute * 60.0f * kHz),
          lone,
          true};
}

TEST(Quarantine, SixVotesInFewMinutesAreNotEnough) {
  Quarantine q(kHz);
  for (int i = 0; i < 20; ++i) {
    EXPECT_NE(q.Add(VoteAt(static_cast<float>(i), 0.2f)), Verdict::kConfirmed);
  }
}

TEST(Quarantine, HalfAnHourWithFewVotesIsNotEnough) {
  Quarantine q(kHz);
  for (const float minute : {0.0f, 10.0f, 20.0f, 30.0f, 40.0f}) {
    EXPECT_NE(q.Add(VoteAt(minute, 0.2f)), Verdict::kConfirmed);
  }
  EXPECT_EQ(q.Add(VoteAt(41.0f, 0.2f)), Verdict::kConfirmed);
  EXPECT_NEAR(q.shift_dps()[0], 0.2f, 1e-6f);
}

TEST(Quarantine, OutputFollowsASecondWitnessAndLargeShiftsOnlyMore) {
  for (const auto& [shift_dps, votes] : {std::pair{0.25f, 2}, {0.5f, 3}, {1.0f, 5}, {9.0f, 6}}) {
    Quarantine q(kHz);
    for (int i = 1; i <= 8; ++i) {
      q.Add(VoteAt(static_cast<float>(i), shift_dps));
      EXPECT_EQ(q.follows(), i >= votes) << shift_dps << " dps, " << i << " votes";
    }
    EXPECT_TRUE(q.Clear());
    EXPECT_FALSE(q.follows());
  }
}

TEST(Quarantine, OutputFollowsNothingWhileTheNoiseFloorIsAGuess) {
  Quarantine q(kHz);
  for (int i = 0; i < 20; ++i) {
    Quarantine::Vote vote = VoteAt(static_cast<float>(i), 0.2f);
    vote.clean = false;
    q.Add(vote);
    EXPECT_FALSE(q.follows());
  }
}

TEST(Quarantine, AgreementIsWithinTheJointUncertainty) {
  Quarantine q(kHz);
  EXPECT_FALSE(q.Agrees(VoteAt(0.0f, 0.2f)));  // with nothing
  q.Add(VoteAt(0.0f, 0.2f));
  EXPECT_TRUE(q.Agrees(VoteAt(1.0f, 0.225f)));
  EXPECT_FALSE(q.Agrees(VoteAt(1.0f, 0.235f)));
  Quarantine::Vote vague = VoteAt(1.0f, 0.235f);
  vague.sigma_dps = 0.02f;
  EXPECT_TRUE(q.Agrees(vague));
  vague.shift_dps[0] = 0.26f;  // never farther apart than a step
  EXPECT_FALSE(q.Agrees(vague));
}

TEST(Quarantine, DisagreementStartsAnew) {
  Quarantine q(kHz);
  EXPECT_EQ(q.Add(VoteAt(0.0f, 0.2f)), Verdict::kFirst);
  EXPECT_EQ(q.Add(VoteAt(1.0f, 0.22f)), Verdict::kAgrees);
  EXPECT_EQ(q.Add(VoteAt(2.0f, 0.4f)), Verdict::kReplaced);
  EXPECT_EQ(q.votes(), 1);
}

TEST(Quarantine, TwoCorruptionsInTurnNeverAgree) {
  Quarantine q(kHz);
  for (int i = 0; i < 400; ++i) {
    EXPECT_NE(q.Add(VoteAt(static_cast<float>(5 * i), i % 2 == 0 ? 0.2f : -0.2f)),
              Verdict::kConfirmed);
  }
}

TEST(Quarantine, EvidenceExpiresAfterADay) {
  Quarantine q(kHz);
  q.Add(VoteAt(0.0f, 0.2f));
  EXPECT_FALSE(q.Expire(static_cast<std::uint32_t>(23 * 3600 * kHz)));
  EXPECT_TRUE(q.Expire(static_cast<std::uint32_t>(25 * 3600 * kHz)));
  EXPECT_FALSE(q.Expire(static_cast<std::uint32_t>(26 * 3600 * kHz)));
}

Config Slow() {  // keeps half-hours short to run
  Config config;
  config.sample_hz = 50.0f;
  config.limits.min_samples = 250;
  config.gyro_noise_density_dps_per_rthz = 0.01f;
  return config;
}

void Stills(Bench& bench, int count, Vector shift_dps) {
  for (int i = 0; i < count; ++i) {
    bench.Rest(20.0, 24.0 + 0.5 * (i % 7), shift_dps);
    bench.Shake(40.0, 24.0);
  }
}

TEST(GenuineShift, IsConfirmedAfterHalfAnHourAndMovesTheWholeTable) {
  Bench bench(Slow());
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  Stills(bench, 8, {0, 0, 0});
  bench.Rest(20.0, 35.0);
  bench.Shake(1.0, 35.0);
  const float before = bench.table().At(35.0f).zro_dps[0];
  Stills(bench, 29, {0.2, -0.15, 0});
  EXPECT_EQ(bench.Count(Code::kShiftConfirmed), 0);
  Stills(bench, 5, {0.2, -0.15, 0});
  EXPECT_EQ(bench.Count(Code::kShiftConfirmed), 1);
  EXPECT_NEAR(bench.table().At(25.5f).zro_dps[0], test::TrueOffset(25.5)[0] + 0.2, 0.015);
  EXPECT_NEAR(bench.table().At(25.5f).zro_dps[1], test::TrueOffset(25.5)[1] - 0.15, 0.015);
  EXPECT_NEAR(bench.table().At(35.0f).zro_dps[0], before + 0.2f, 0.03f);
  const int remote = bench.table().InBin(35.0f, Origin::kLearned);
  ASSERT_GE(remote, 0);
  EXPECT_EQ(bench.table()[remote].date, 0);  // shifted unseen: old, to be renewed by a reading
  bench.corrector().RestoreFactory();        // the factory's own figures were kept
  EXPECT_NEAR(bench.table().At(25.0f).zro_dps[0], test::TrueOffset(25.0)[0], 0.006);
}

double OutputErrorAfter(Bench& bench, double still_s, Vector shift_dps) {
  double error = 0.0;
  bench.Run(
      still_s,
      [&](double) {
        return Scene{25.0, shift_dps};
      },
      [&](const Scene& scene, const Output& out) {
        error = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
          const double truth = test::TrueOffset(scene.temp_degc)[i] + shift_dps[i];
          error = std::max(error, std::abs(static_cast<double>(out.zro_dps[i]) - truth));
        }
      });
  bench.Shake(40.0, 25.0);
  return error;
}

TEST(GenuineShift, OutputFollowsAtTheSecondStillAndReturnsAtTheFirstThatDisagrees) {
  Bench bench(Slow());
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  Stills(bench, 5, {0, 0, 0});
  const int writes = bench.Writes();
  const Vector shift = {0.2, -0.15, 0};
  EXPECT_GT(OutputErrorAfter(bench, 20.0, shift), 0.18);
  EXPECT_LT(OutputErrorAfter(bench, 7.0, shift), 0.015);  // one reading of the second still
  EXPECT_LT(OutputErrorAfter(bench, 7.0, shift), 0.015);
  EXPECT_EQ(bench.Writes(), writes);  // the table has not moved
  EXPECT_LT(bench.ErrorAt(25.0), 0.01);
  EXPECT_LT(OutputErrorAfter(bench, 7.0, {0, 0, 0}), 0.015);
  EXPECT_EQ(bench.Count(Code::kShiftConfirmed), 0);
}

TEST(GenuineShift, HalfADegreeASecondTwiceInARowIsNotFollowed) {
  Bench bench(Slow());
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  Stills(bench, 5, {0, 0, 0});
  for (int i = 0; i < 2; ++i) EXPECT_GT(OutputErrorAfter(bench, 20.0, {0, 0, 0.5}), 0.48);
  EXPECT_LT(OutputErrorAfter(bench, 7.0, {0, 0, 0}), 0.015);
}

TEST(GenuineShift, NoiseALittleAboveItsFloorIsNoEvidence) {
  Bench bench(Slow());
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  Stills(bench, 5, {0, 0, 0});
  for (int i = 0; i < 4; ++i) {
    bench.Run(20.0, [](double) { return Scene{25.0, {0.2, 0, 0}, 1.25}; });
    bench.Shake(40.0);
  }
  EXPECT_GE(bench.Count(Code::kDiffersFromEntry), 1);  // let through to figure 5
  EXPECT_EQ(bench.Count(Code::kQuarantined), 0);
}

TEST(GenuineShift, QuarterOfAnHourOfSlowRotationIsNotBelieved) {
  Bench bench(Slow());
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  Stills(bench, 5, {0, 0, 0});
  Stills(bench, 15, {0, 0, 0.5});
  Stills(bench, 2, {0, 0, 0});
  EXPECT_EQ(bench.Count(Code::kShiftConfirmed), 0);
  EXPECT_EQ(bench.Count(Code::kQuarantineExpired), 1);  // an agreeing reading cleared it
  EXPECT_LT(bench.ErrorAt(25.0), 0.01);
}

TEST(GenuineShift, OneLongStillIsOneVote) {
  Bench bench(Slow());
  bench.AddFactory({10, 25, 40});
  bench.Rest(3 * 3600.0, 25.0, {0, 0, 0.5});  // a turntable
  EXPECT_EQ(bench.Writes(), 0);
  EXPECT_EQ(bench.Count(Code::kQuarantined), 1);
  EXPECT_LE(bench.Count(Code::kDiffersFromEntry), 180);
}

TEST(GenuineShift, NoisyReadingsNeverBecomeEvidence) {
  Bench bench(Slow());
  bench.AddFactory({10, 25, 40});
  Stills(bench, 2, {0, 0, 0});
  for (int i = 0; i < 40; ++i) {
    bench.Run(20.0, [](double) { return Scene{25.0, {0.3, -0.2, 0.0}, 1.6}; });
    bench.Shake(40.0);
  }
  EXPECT_EQ(bench.Count(Code::kQuarantined), 0);
  EXPECT_GE(bench.Count(Code::kAcousticOrVibration), 40);
  EXPECT_LT(bench.ErrorAt(25.0), 0.01);
}

TEST(GenuineShift, ColdTableWithABadFirstReadingRecoversByTheSecondWitness) {
  Bench bench(Slow());
  Stills(bench, 1, {0, 0, 0.5});  // slow rotation, and nothing to compare with
  ASSERT_EQ(bench.table().size(), 1);
  Stills(bench, 2, {0, 0, 0});
  EXPECT_EQ(bench.Count(Code::kShiftConfirmed), 1);
  EXPECT_LT(bench.ErrorAt(24.5), 0.015);
}

}  // namespace
}  // namespace zro
