#include "rig/profile/profile.h"

#include <gmock/gmock.h>

#include <set>

#include "rig/profile/plan.h"
#include "tests/unit/core/toml_text.h"

namespace zrobench {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pair;
using testing::SizeIs;
using testing::VariantWith;

template <typename T>
T Need(const Result<T>& result) {
  if (!result) throw std::runtime_error(result.error().message);
  return *result;
}
std::filesystem::path Shipped(const std::string& name) {
  return std::filesystem::path(ZROBENCH_SOURCE_DIR) / "profiles" / name;
}
Profile LoadText(const std::string& text, const Station& station) {
  return Need(LoadProfile(TextFile(text).path(), station));
}

TEST(Profile, EveryKindArrives) {
  Station station;
  station.model.speaker.pa_per_v = 2;
  const Profile p = LoadText(R"(schema = 1
name = "all"
about = "kinds"
[needs]
min_degc = 10
max_degc = 50
speaker = true
power = true
[[step]]
soak = { to_degc = 20, hold_s = 30 }
[[step]]
ramp = { to_degc = 40, rate_degc_per_min = 2 }
with = [ { tone = { hz = 1000, spl_db = 100, for_s = 5 }, at_degc = 30 },
         { move = { how = "rotate", for_s = 4 }, at_s = 60 } ]
[[step]]
hold = { for_s = 7 }
[[step]]
tone = { hz = 2000, v = 0.5, for_s = 3 }
[[step]]
move = { how = "hand_held", for_s = 8 }
[[step]]
power_cycle = { off_s = 2 }
[[expect]]
rejects = { code = 10, during = "tone", at_least = 2 }
[[expect]]
rejects = { codes = [1, 9] }
[[expect]]
table_coverage = { from_degc = 20, to_degc = 40, step_degc = 2.5, min_pct = 80 }
[[expect]]
lockstep = {}
)",
                             station);
  EXPECT_EQ(p.name, "all");
  EXPECT_EQ(p.about, "kinds");
  EXPECT_EQ(p.needs.min_degc, 10);
  EXPECT_EQ(p.needs.max_degc, 50);
  EXPECT_TRUE(p.needs.speaker && p.needs.power);
  ASSERT_THAT(p.steps, SizeIs(6));
  const Soak& soak = std::get<Soak>(p.steps[0].action);
  EXPECT_EQ(soak.to_degc, 20);
  EXPECT_EQ(soak.hold_s, 30);
  EXPECT_EQ(soak.settled_degc, 0.3);
  EXPECT_EQ(p.steps[0].line, 9);
  EXPECT_EQ(std::get<Ramp>(p.steps[1].action).rate_degc_per_min, 2);
  ASSERT_THAT(p.steps[1].with, SizeIs(2));
  const Tone& burst = std::get<Tone>(p.steps[1].with[0].what);
  EXPECT_EQ(burst.spl_db, 100);
  EXPECT_THAT(burst.v, DoubleNear(1.0, 1e-12));  // 100 dB is 2 Pa; this speaker makes 2 Pa a volt
  EXPECT_EQ(p.steps[1].with[0].at_degc, 30);
  EXPECT_FALSE(p.steps[1].with[0].at_s);
  EXPECT_EQ(std::get<Move>(p.steps[1].with[1].what).how, "rotate");
  EXPECT_EQ(p.steps[1].with[1].at_s, 60);
  EXPECT_EQ(std::get<Hold>(p.steps[2].action).for_s, 7);
  const Tone& tone = std::get<Tone>(p.steps[3].action);
  EXPECT_EQ(tone.v, 0.5);
  EXPECT_THAT(tone.spl_db, DoubleNear(93.979, 1e-3));  // 1 Pa
  EXPECT_EQ(std::get<Move>(p.steps[4].action).for_s, 8);
  EXPECT_EQ(std::get<PowerCycle>(p.steps[5].action).off_s, 2);
  ASSERT_THAT(p.expects, SizeIs(4));
  EXPECT_THAT(p.expects[0].arguments,
              ElementsAre(Pair("codes", VariantWith<std::vector<double>>(ElementsAre(10))),
                          Pair("during", VariantWith<std::string>("tone")),
                          Pair("at_least", VariantWith<double>(2))));
  EXPECT_THAT(p.expects[1].arguments,
              ElementsAre(Pair("codes", VariantWith<std::vector<double>>(ElementsAre(1, 9)))));
  EXPECT_EQ(p.expects[2].number("step_degc", 0), 2.5);
  EXPECT_EQ(p.expects[2].number("absent", -1), -1);
  EXPECT_EQ(p.expects[3].check, "lockstep");
}

TEST(Profile, EveryShippedProfileFitsTheShippedStation) {
  const Station station = Need(LoadStation(Shipped("stations/virtual.toml")));
  int profiles = 0;
  for (const auto& entry : std::filesystem::directory_iterator(Shipped(""))) {
    if (entry.path().extension() != ".toml") continue;
    const Result<Profile> profile = LoadProfile(entry.path(), station);
    EXPECT_TRUE(profile) << profile.error().message;
    ++profiles;
  }
  EXPECT_GE(profiles, 1);
}

TEST(Profile, QuickLookIsQuickAndAsksForEverything) {
  const Station station = Need(LoadStation(Shipped("stations/virtual.toml")));
  const Profile p = Need(LoadProfile(Shipped("quick-look.toml"), station));
  EXPECT_LE(NominalDurationS(p, station.model.ambient_degc), 600);
  std::set<std::string> checks;
  for (const Expectation& expectation : p.expects) checks.insert(expectation.check);
  EXPECT_THAT(checks, ElementsAre("lockstep", "no_corrupt_entry", "rejects", "residual_rate",
                                  "table_accuracy", "table_coverage", "table_persists"));
}

}  // namespace
}  // namespace zrobench
