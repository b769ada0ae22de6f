#include "core/clock.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace zrobench {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// An event every 10 ms; becomes ready after a given number of them.
class Metronome final : public Simulation, public WaitSource {
 public:
  explicit Metronome(int ready_after) : ready_after_(ready_after) {}
  Instant next_event() const override { return Instant(milliseconds(10) * (count_ + 1)); }
  void Run(Instant t) override {
    ++count_;
    ran_at.push_back(t);
  }
  bool ready() const override { return count_ >= ready_after_; }
  std::vector<Instant> ran_at;

 private:
  int ready_after_;
  int count_ = 0;
};

TEST(VirtualClock, WaitRunsEveryEventUpToTheDeadlineAndNoFurther) {
  VirtualClock clock(0);
  Metronome metronome(1000);
  clock.Attach(&metronome);
  clock.Wait(Instant(milliseconds(35)), {});
  EXPECT_EQ(metronome.ran_at.size(), 3u);
  EXPECT_EQ(clock.now(), Instant(milliseconds(35)));
  clock.Wait(Instant(milliseconds(40)), {});  // an event exactly at the deadline runs
  EXPECT_EQ(metronome.ran_at.back(), Instant(milliseconds(40)));
}

TEST(VirtualClock, WaitEndsAtTheEventThatMakesASourceReady) {
  VirtualClock clock(0);
  Metronome metronome(2);
  clock.Attach(&metronome);
  const std::array<const WaitSource*, 1> sources{&metronome};
  clock.Wait(Instant(seconds(1)), sources);
  EXPECT_EQ(clock.now(), Instant(milliseconds(20)));
}

TEST(VirtualClock, WallTimeFollowsTheEpochAndTheDateStep) {
  VirtualClock clock(1'000);
  clock.Wait(Instant(seconds(2)), {});
  EXPECT_EQ(clock.utc(), 2'000'001'000);
  clock.AdvanceDate(std::chrono::hours(24));
  EXPECT_EQ(clock.utc(), 2'000'001'000 + 86'400'000'000'000);
  EXPECT_EQ(clock.now(), Instant(seconds(2)));
}

TEST(RealClock, WaitLastsUntilTheDeadline) {
  RealClock clock;
  const Instant deadline = clock.now() + milliseconds(20);
  clock.Wait(deadline, {});
  EXPECT_GE(clock.now(), deadline);
}

}  // namespace
}  // namespace zrobench
