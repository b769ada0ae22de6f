#include "core/key_names.h"

#include <gtest/gtest.h>

namespace zrobench {
namespace {

const std::vector<std::string> kRamp = {"to_degc", "rate_degc_per_min"};

TEST(SuggestKey, AWrongUnitNamesTheRightKey) {
  EXPECT_EQ(SuggestKey("rate_degc_per_s", kRamp),
            "wrong unit, write it in degc_per_min as 'rate_degc_per_min'");
  EXPECT_EQ(SuggestKey("to_degf", kRamp), "wrong unit, write it in degc as 'to_degc'");
  EXPECT_EQ(SuggestKey("khz", {"hz", "v", "spl_db"}), "wrong unit, write it in hz as 'hz'");
  EXPECT_EQ(SuggestKey("db", {"hz", "v", "spl_db"}), "wrong unit, write it in spl_db as 'spl_db'");
}

TEST(SuggestKey, AMissingUnitIsSaid) {
  EXPECT_EQ(SuggestKey("rate", kRamp), "with its unit it is 'rate_degc_per_min'");
}

TEST(SuggestKey, AMisspellingGetsTheNearestName) {
  EXPECT_EQ(SuggestKey("rate_dgc_per_min", kRamp), "did you mean 'rate_degc_per_min'?");
  EXPECT_EQ(SuggestKey("naem", {"name", "about"}), "did you mean 'name'?");
}

TEST(SuggestKey, WithoutANearOneTheListIsGiven) {
  EXPECT_EQ(SuggestKey("colour", kRamp), "known: to_degc, rate_degc_per_min");
  EXPECT_EQ(SuggestKey("anything", {}), "it takes no keys");
}

TEST(NearestName, DoesNotGuessWildly) {
  EXPECT_EQ(NearestName("hovering", {"tap", "rotate"}), "");
  EXPECT_EQ(NearestName("rotat", {"tap", "rotate"}), "rotate");
}

}  // namespace
}  // namespace zrobench
