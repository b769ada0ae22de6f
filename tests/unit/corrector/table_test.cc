#include "corrector/table.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <vector>

#include "corrector/corrector.h"
#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using Bytes = std::vector<std::uint8_t>;

rc::Gen<Entry> AnyEntry() {
  return rc::gen::map(rc::gen::tuple(rc::gen::inRange(-4000, 8500), rc::gen::inRange(-9000, 9000),
                                     rc::gen::inRange(1, 100), rc::gen::arbitrary<std::uint16_t>(),
                                     rc::gen::inRange(1, 256), rc::gen::inRange(0, 4)),
                      [](const std::tuple<int, int, int, std::uint16_t, int, int>& t) {
                        const float zro = static_cast<float>(std::get<1>(t)) * 1e-3f;
                        Entry e{static_cast<float>(std::get<0>(t)) * 0.01f,
                                {zro, -zro, 0.5f * zro},
                                0.0f,
                                0,
                                1,
                                Origin::kLearned};
                        e.sigma_dps = static_cast<float>(std::get<2>(t)) * 1e-4f;
                        e.date = std::get<3>(t);
                        e.weight = static_cast<std::uint8_t>(std::get<4>(t));
                        if (std::get<5>(t) == 0) e.origin = Origin::kFactory;
                        return e;
                      });
}

Bytes ImageOf(const Table& table, std::uint32_t generation) {
  Bytes image(Table::kMaxImageBytes);
  image.resize(table.ToImage(generation, image.data()));
  return image;
}

Entry Learned(float temp_degc, float zro_dps, std::uint16_t date = 100) {
  return {temp_degc, {zro_dps, -zro_dps, 0.0f}, 0.002f, date, 1, Origin::kLearned};
}
Entry Factory(float temp_degc, float zro_dps) {
  return {temp_degc, {zro_dps, -zro_dps, 0.0f}, 0.005f, 0, 1, Origin::kFactory};
}

RC_GTEST_PROP(Table, StaysSortedWithOneEntryABinAndOrigin, ()) {
  const auto entries = *rc::gen::container<std::vector<Entry>>(AnyEntry());
  Table table;
  for (const Entry& e : entries) {
    table.Insert(e);
    RC_ASSERT(table.size() <= Table::kCapacity);
  }
  for (int i = 0; i < table.size(); ++i) {
    RC_ASSERT(table.InBin(table[i].temp_degc, table[i].origin) ==
              i);  // nobody before it in its bin
    if (i > 0) RC_ASSERT(table[i - 1].temp_degc <= table[i].temp_degc);
  }
}

RC_GTEST_PROP(Table, ImageRoundTripIsExact, ()) {
  const auto entries = *rc::gen::container<std::vector<Entry>>(AnyEntry());
  const auto generation = *rc::gen::arbitrary<std::uint32_t>();
  Table table;
  for (const Entry& e : entries) table.Insert(e);
  const Bytes image = ImageOf(table, generation);
  Table copy;
  std::uint32_t read = 0;
  RC_ASSERT(copy.FromImage(image.data(), image.size(), &read));
  RC_ASSERT(read == generation);
  RC_ASSERT(ImageOf(copy, read) == image);
}

RC_GTEST_PROP(Table, RandomBytesAreNoImage, (const Bytes& bytes)) {
  Table table;
  table.Insert(Learned(20.0f, 0.5f));
  std::uint32_t generation = 7;
  RC_ASSERT(!table.FromImage(bytes.data(), bytes.size(), &generation));
  RC_ASSERT(table.size() == 1);
  RC_ASSERT(generation == 7u);
}

RC_GTEST_PROP(Table, DamagedImagesAreRefusedOrCanonical, ()) {
  Table table;
  for (const float t : {5.0f, 15.0f, 25.0f}) table.Insert(Learned(t, 0.1f * t));
  Bytes image = ImageOf(table, 3);
  const auto at = *rc::gen::inRange<std::size_t>(0, image.size());
  image[at] = *rc::gen::arbitrary<std::uint8_t>();
  Table read;
  std::uint32_t generation = 0;
  if (read.FromImage(image.data(), image.size(), &generation)) {
    RC_ASSERT(ImageOf(read, generation) == image);
  } else {
    RC_ASSERT(read.size() == 0);
  }
}

TEST(Table, ImageLayoutIsTheDocumentedOne) {
  Table table;
  table.Insert(Learned(1.0f, 2.0f, 0x1234));
  const Bytes image = ImageOf(table, 0x01020304);
  const Bytes header = {1, 0, 1, 0, 4, 3, 2, 1, 2, 0, 0, 0, 0, 0, 0, 0};
  ASSERT_EQ(image.size(), 40u);
  EXPECT_EQ(Bytes(image.begin(), image.begin() + 16), header);
  const Bytes temp_and_x = {0, 0, 0x80, 0x3F, 0, 0, 0, 0x40};
  EXPECT_EQ(Bytes(image.begin() + 16, image.begin() + 24), temp_and_x);
  const Bytes tail = {0x34, 0x12, 1, 2};
  EXPECT_EQ(Bytes(image.end() - 4, image.end()), tail);
}

TEST(Table, ImageOfUnsortedOrUnfitEntriesIsRefused) {
  Table table;
  table.Insert(Learned(10.0f, 0.1f));
  table.Insert(Learned(20.0f, 0.2f));
  const Bytes good = ImageOf(table, 1);
  std::uint32_t generation = 0;
  const auto refused = [&](const Bytes& image) {
    Table read;
    return !read.FromImage(image.data(), image.size(), &generation);
  };
  Bytes swapped = good;
  std::swap_ranges(swapped.begin() + 16, swapped.begin() + 40, swapped.begin() + 40);
  EXPECT_TRUE(refused(swapped));
  Bytes nan = good;
  nan[16 + 6] = 0xC0, nan[16 + 7] = 0x7F;  // first offset
  EXPECT_TRUE(refused(nan));
  Bytes weightless = good;
  weightless[16 + 22] = 0;
  EXPECT_TRUE(refused(weightless));
  Bytes wrong_origin = good;
  wrong_origin[8] = 1;
  EXPECT_TRUE(refused(wrong_origin));
  Bytes twice = good;  // the second entry in the first one's bin
  twice[40 + 2] = 0x28, twice[40 + 3] = 0x41;
  EXPECT_TRUE(refused(twice));
  Bytes twins = good;
  std::copy_n(twins.begin() + 16, 24, twins.begin() + 40);
  EXPECT_TRUE(refused(twins));
  EXPECT_FALSE(refused(good));
}

TEST(Table, ImageWithMoreFactoryEntriesThanATableTakesIsRefused) {
  const auto image_of = [](int factory) {
    Bytes image(Table::kHeaderBytes);
    image[0] = Table::kLayoutVersion;
    image[2] = static_cast<std::uint8_t>(factory);
    image[8] = 1;
    for (int i = 0; i < factory; ++i) {
      Table one;
      one.Insert(Factory(-39.0f + 2.5f * static_cast<float>(i), 0.0f));
      const Bytes entry = ImageOf(one, 0);
      image.insert(image.end(), entry.begin() + Table::kHeaderBytes, entry.end());
    }
    return image;
  };
  Table read;
  std::uint32_t generation = 0;
  const Bytes most = image_of(Table::kFactoryCapacity);
  EXPECT_TRUE(read.FromImage(most.data(), most.size(), &generation));
  const Bytes more = image_of(Table::kFactoryCapacity + 1);
  EXPECT_FALSE(read.FromImage(more.data(), more.size(), &generation));
}

TEST(Table, FullTableGivesUpItsOldestLearnedEntryNeverAFactoryOne) {
  Table table;
  table.Insert(Factory(0.0f, 0.1f));
  for (int i = 0; i < Table::kCapacity - 1; ++i) {
    const auto date = static_cast<std::uint16_t>(i == 20 ? 5 : 100 + i);
    ASSERT_TRUE(table.Insert(Learned(-39.0f + 2.5f * static_cast<float>(i), 0.0f, date)));
  }
  ASSERT_EQ(table.size(), Table::kCapacity);
  ASSERT_GE(table.InBin(11.0f, Origin::kLearned), 0);
  EXPECT_TRUE(table.Insert(Learned(84.0f, 0.3f, 200)));
  EXPECT_EQ(table.size(), Table::kCapacity);
  EXPECT_EQ(table.InBin(11.0f, Origin::kLearned), -1);  // the one dated 5
  EXPECT_GE(table.InBin(84.0f, Origin::kLearned), 0);
  EXPECT_GE(table.InBin(0.0f, Origin::kFactory), 0);
}

TEST(Table, FactoryEntriesLeaveRoomForLearning) {
  Table table;
  for (int i = 0; i < Table::kFactoryCapacity; ++i) {
    EXPECT_TRUE(table.Insert(Factory(-39.0f + 2.5f * static_cast<float>(i), 0.0f)));
  }
  EXPECT_FALSE(table.Insert(Factory(84.0f, 0.0f)));
  EXPECT_TRUE(table.Insert(Learned(84.0f, 0.0f)));
}

TEST(Table, LearnedEntryShadowsTheFactoryOneAndLeavingItOutRevealsIt) {
  Table table;
  table.Insert(Factory(20.0f, 0.5f));
  table.Insert(Learned(20.6f, 0.7f));
  EXPECT_FLOAT_EQ(table.At(20.0f).zro_dps[0], 0.7f);
  EXPECT_FLOAT_EQ(table.At(20.0f, 1).zro_dps[0], 0.5f);
  EXPECT_EQ(table.Nearest(20.0f), 1);
}

TEST(Table, InterpolatesLinesExactlyAndParabolasAcrossWideGaps) {
  const auto curve = [](float t) { return 0.3f + 0.02f * t - 5e-4f * t * t; };
  Table table;
  for (const float t : {10.0f, 25.0f, 40.0f}) table.Insert(Factory(t, curve(t)));
  for (float t = 0.0f; t <= 50.0f; t += 2.0f) {
    EXPECT_NEAR(table.At(t).zro_dps[0], curve(t), 1e-4f) << t;
  }
  Table line;
  line.Insert(Learned(10.0f, 0.1f));
  line.Insert(Learned(13.0f, 0.2f));
  EXPECT_NEAR(line.At(11.5f).zro_dps[0], 0.15f, 1e-6f);
}

TEST(Table, ThirdEntryAcrossAWideGapIsTheNearerOne) {
  Table table;
  for (const float t : {10.0f, 20.0f, 30.0f, 60.0f}) table.Insert(Learned(t, 0.5f));
  EXPECT_NEAR(table.At(21.0f).model_dps, 1e-5f * 1.0f * 9.0f * 11.0f, 1e-6f);
  Table mirrored;
  for (const float t : {-20.0f, 10.0f, 20.0f, 30.0f}) mirrored.Insert(Learned(t, 0.5f));
  EXPECT_NEAR(mirrored.At(19.0f).model_dps, 1e-5f * 1.0f * 9.0f * 11.0f, 1e-6f);
}

TEST(Table, ExtrapolationIsHeldBeyondItsReach) {
  Table table;
  table.Insert(Factory(20.0f, 0.2f));
  table.Insert(Factory(30.0f, 0.5f));
  EXPECT_NEAR(table.At(35.0f).zro_dps[0], 0.65f, 1e-5f);
  EXPECT_NEAR(table.At(40.0f).zro_dps[0], 0.80f, 1e-5f);
  EXPECT_NEAR(table.At(80.0f).zro_dps[0], 0.80f, 1e-5f);
  EXPECT_TRUE(table.At(35.0f).extrapolated);
  EXPECT_GT(table.At(80.0f).sigma_dps, table.At(40.0f).sigma_dps);
}

TEST(Table, ALoneEntryOrTwoNeighboursGiveNoWildSlope) {
  Table table;
  table.Insert(Learned(19.99f, 0.500f));
  table.Insert(Learned(20.01f, 0.504f));  // the next bin; 200 mdps/degC if taken for a slope
  EXPECT_NEAR(table.At(30.0f).zro_dps[0], 0.504f, 1e-5f);
  EXPECT_GT(table.At(30.0f).model_dps, 0.3f);
}

TEST(Table, ExtrapolationDoesNotMagnifyTheNoiseOfADenseTable) {
  std::mt19937_64 rng(4);
  std::normal_distribution<float> noise(0.0f, 0.002f);
  for (int trial = 0; trial < 200; ++trial) {
    Table table;
    for (float t = 20.5f; t < 40.0f; t += 2.5f) table.Insert(Learned(t, 0.02f * t + noise(rng)));
    EXPECT_NEAR(table.At(48.0f).zro_dps[0], 0.96f, 0.06f);
  }
}

TEST(Table, CorrectorFitsSmallTargets) { EXPECT_LE(sizeof(Corrector), 2048u); }

}  // namespace
}  // namespace zro
