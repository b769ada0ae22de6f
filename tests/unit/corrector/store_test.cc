#include "corrector/store.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "corrector/crc32.h"
#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

using test::Bench;
using test::RamStorage;
using Bytes = std::vector<std::uint8_t>;

Table Holding(float zro_dps) {
  Table table;
  table.Insert({20.0f, {zro_dps, 0.0f, 0.0f}, 0.002f, 10, 1, Origin::kLearned});
  return table;
}

Bytes ImageOf(const Table& table) {
  Bytes image(Table::kMaxImageBytes);
  image.resize(table.ToImage(0, image.data()));
  return image;
}

TEST(Crc32, CheckValue) {
  const std::uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(Crc32(digits, sizeof digits), 0xCBF43926u);
}

TEST(Store, PowerCutAtAnyByteLeavesTheOldTableOrTheNew) {
  for (const int earlier_writes : {1, 2, 3}) {
    RamStorage before;
    Store writer(&before);
    Table read;
    std::uint32_t generation = 0;
    writer.Read(&read, &generation);
    for (int i = 1; i <= earlier_writes; ++i)
      writer.Write(Holding(0.1f * static_cast<float>(i)), static_cast<std::uint32_t>(i));
    const float old_dps = 0.1f * static_cast<float>(earlier_writes);
    for (std::size_t cut = 0; cut <= Store::kSlotBytes; ++cut) {
      RamStorage storage = before;
      storage.cut_at = cut;
      Store store(&storage);
      store.Read(&read, &generation);
      store.Write(Holding(9.0f), 99);
      Store reborn(&storage);
      Table after;
      ASSERT_EQ(reborn.Read(&after, &generation), Store::Load::kLoaded) << cut;
      ASSERT_EQ(after.size(), 1);
      const bool is_new = after[0].zro_dps[0] == 9.0f;
      ASSERT_EQ(generation, is_new ? 99u : static_cast<std::uint32_t>(earlier_writes)) << cut;
      if (!is_new) {
        ASSERT_FLOAT_EQ(after[0].zro_dps[0], old_dps) << cut;
      }
      ASSERT_TRUE(is_new || cut < Store::kSlotBytes);
    }
  }
}

TEST(Store, CutFirstWriteOfABlankStoreIsReportedNotBelieved) {
  RamStorage storage;
  storage.cut_at = 100;
  Store(&storage).Write(Holding(1.0f), 1);
  Table table;
  std::uint32_t generation = 0;
  EXPECT_EQ(Store(&storage).Read(&table, &generation), Store::Load::kInvalid);
  EXPECT_EQ(table.size(), 0);
}

TEST(Store, EverySingleBitFlipIsSeen) {
  RamStorage storage;
  Store(&storage).Write(Holding(1.0f), 1);
  for (std::size_t bit = 0; bit < 8 * Store::kSlotBytes; bit += 7) {
    RamStorage flipped = storage;
    flipped.slots[0][bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    Table table;
    std::uint32_t generation = 0;
    ASSERT_EQ(Store(&flipped).Read(&table, &generation), Store::Load::kInvalid) << bit;
  }
}

TEST(Store, NewestSlotHoldsEvenWhenTheSequenceWraps) {
  RamStorage storage;
  Store::Seal(Holding(1.0f), 1, 0xFFFFFFFFu, storage.slots[0].data());
  Store::Seal(Holding(2.0f), 2, 0u, storage.slots[1].data());
  Table table;
  std::uint32_t generation = 0;
  ASSERT_EQ(Store(&storage).Read(&table, &generation), Store::Load::kLoaded);
  EXPECT_FLOAT_EQ(table[0].zro_dps[0], 2.0f);
}

TEST(Store, SlotsOfVersionOneAreReadForEver) {  // these very bytes are in the field
  const Bytes head = {
      0x5A, 0x52, 0x4F, 0x54, 0x01, 0x00, 0x40, 0x00, 0x29, 0x00, 0x00, 0x00, 0x01,
      0x00, 0x02, 0x00, 0x07, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x00, 0x00,
      0x00, 0x00, 0x00, 0x00, 0xA0, 0x41, 0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0xA0,
      0xBF, 0x00, 0x00, 0x00, 0x3E, 0x0A, 0xD7, 0x23, 0x3C, 0x00, 0x00, 0x01, 0x01,
      0x00, 0x00, 0xBC, 0x41, 0x00, 0x00, 0x10, 0x3F, 0x00, 0x00, 0xB0, 0xBF, 0x00,
      0x00, 0x80, 0x3E, 0x0A, 0xD7, 0x23, 0x3B, 0x98, 0x3A, 0x03, 0x02,
  };
  RamStorage storage;
  Bytes& slot = storage.slots[0];
  slot.assign(Store::kSlotBytes, 0);
  std::copy(head.begin(), head.end(), slot.begin());
  const std::uint32_t crc = 0x23A0DA01u;
  std::memcpy(slot.data() + Store::kSlotBytes - 4, &crc, 4);
  Table table;
  std::uint32_t generation = 0;
  ASSERT_EQ(Store(&storage).Read(&table, &generation), Store::Load::kLoaded);
  EXPECT_EQ(generation, 7u);
  ASSERT_EQ(table.size(), 2);
  EXPECT_EQ(table[0].origin, Origin::kFactory);
  EXPECT_FLOAT_EQ(table[0].zro_dps[1], -1.25f);
  EXPECT_FLOAT_EQ(table[1].temp_degc, 23.5f);
  EXPECT_FLOAT_EQ(table[1].sigma_dps, 0.0025f);
  EXPECT_EQ(table[1].date, 15000);
  EXPECT_EQ(table[1].weight, 3);
}

RC_GTEST_PROP(Store, RubbishWithAGoodChecksumIsRefusedOrCanonical, ()) {
  RamStorage storage;
  Bytes& slot = storage.slots[0];
  Store::Seal(Holding(1.0f), 1, 1, slot.data());
  const auto changes = *rc::gen::inRange(1, 6);
  for (int i = 0; i < changes; ++i) {  // prefix and image, not the padding alone
    slot[*rc::gen::inRange<std::size_t>(4, 64)] = *rc::gen::arbitrary<std::uint8_t>();
  }
  const std::uint32_t crc = Crc32(slot.data(), Store::kSlotBytes - 4);
  std::memcpy(slot.data() + Store::kSlotBytes - 4, &crc, 4);
  Table table;
  std::uint32_t generation = 0;
  if (Store(&storage).Read(&table, &generation) != Store::Load::kLoaded) {
    RC_ASSERT(table.size() == 0);
    return;
  }
  Bytes image(Table::kMaxImageBytes);
  image.resize(table.ToImage(generation, image.data()));
  RC_ASSERT(std::equal(image.begin(), image.end(), slot.begin() + Store::kPrefixBytes));
}

RC_GTEST_PROP(Store, RandomSlotsNeverLoad, (Bytes bytes)) {
  RamStorage storage;
  if (bytes.empty()) bytes.push_back(1);
  for (Bytes& slot : storage.slots) {
    for (std::size_t i = 0; i < slot.size(); ++i) slot[i] = bytes[i % bytes.size()];
  }
  Table table;
  std::uint32_t generation = 0;
  RC_ASSERT(Store(&storage).Read(&table, &generation) != Store::Load::kLoaded);
}

TEST(Store, OtherSlotVersionIsInvalid) {
  RamStorage storage;
  Store::Seal(Holding(1.0f), 1, 1, storage.slots[0].data());
  storage.slots[0][4] = 2;
  const std::uint32_t crc = Crc32(storage.slots[0].data(), Store::kSlotBytes - 4);
  std::memcpy(storage.slots[0].data() + Store::kSlotBytes - 4, &crc, 4);
  Table table;
  std::uint32_t generation = 0;
  EXPECT_EQ(Store(&storage).Read(&table, &generation), Store::Load::kInvalid);
}

TEST(CorrectorStore, RebootRestoresTheTableBitForBit) {
  Bench bench;
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  for (const double t : {20.0, 23.0, 26.0}) {
    bench.Rest(7.0, t);
    bench.Shake(1.0, t);
  }
  ASSERT_FALSE(bench.corrector().dirty());  // committed within a second
  Corrector reborn(Config{}, &bench.storage);
  reborn.Boot();
  EXPECT_EQ(ImageOf(reborn.table()), ImageOf(bench.table()));
  EXPECT_EQ(reborn.generation(), bench.corrector().generation());
}

TEST(CorrectorStore, UnreadableOrGarbledStoreGivesCode13AndAnEmptyTable) {
  RamStorage storage;
  storage.slots[1].assign(Store::kSlotBytes, 0x5A);
  Corrector corrector(Config{}, &storage);
  corrector.Boot();
  Event event;
  ASSERT_TRUE(corrector.PopEvent(&event));
  EXPECT_EQ(event.code, Code::kStoreInvalid);
  EXPECT_EQ(event.bin, kNoBin);  // no temperature known yet
  EXPECT_EQ(corrector.table().size(), 0);
  Sample sample{{1.0f, 2.0f, 3.0f}, {0.0f, 0.0f, 1.0f}, 25.0f, 1, false, false, false};
  const Output out = corrector.Step(sample);
  EXPECT_EQ(out.source, Source::kInvalidLut);
  EXPECT_FLOAT_EQ(out.rate_dps[2], 3.0f);
}

TEST(CorrectorStore, BlankStoreIsNoError) {
  RamStorage storage;
  Corrector corrector(Config{}, &storage);
  corrector.Boot();
  Event event;
  EXPECT_FALSE(corrector.PopEvent(&event));
}

TEST(CorrectorStore, FailedWriteIsCode14AndTriedAgain) {
  Bench bench;
  bench.storage.fail_writes = true;
  bench.Rest(8.0);
  EXPECT_EQ(bench.Count(Code::kStoreWrite), 1);
  EXPECT_TRUE(bench.corrector().dirty());
  bench.storage.fail_writes = false;
  bench.Rest(62.0);
  EXPECT_FALSE(bench.corrector().dirty());
  EXPECT_EQ(bench.storage.writes, 2);
}

TEST(CorrectorStore, FailingMemoryIsNotHammeredHoweverMuchIsLearned) {
  Bench bench;
  bench.storage.fail_writes = true;
  for (int i = 0; i < 15; ++i) {  // 2 min, a new entry every 8 s
    bench.Rest(7.0, 20.0 + 2.5 * i);
    bench.Shake(1.0, 20.0 + 2.5 * i);
  }
  EXPECT_EQ(bench.Count(Code::kNew), 15);
  EXPECT_EQ(bench.storage.writes, 2);
  EXPECT_LT(bench.ErrorAt(40.0), 0.01);  // the table serves all the same
  bench.storage.fail_writes = false;
  bench.Rest(60.0, 25.0);
  EXPECT_FALSE(bench.corrector().store_failing());
  EXPECT_TRUE(bench.corrector().Commit());  // what merged since
  Corrector reborn(Config{}, &bench.storage);
  reborn.Boot();
  EXPECT_EQ(ImageOf(reborn.table()), ImageOf(bench.table()));
}

TEST(CorrectorStore, RestoreThatCouldNotBeStoredIsTriedAgain) {
  Bench bench;
  bench.AddFactory({10, 25, 40});
  bench.Rest(8.0, 25.0);
  bench.storage.fail_writes = true;
  EXPECT_FALSE(bench.corrector().RestoreFactory());
  bench.storage.fail_writes = false;
  bench.Shake(61.0);
  Corrector reborn(Config{}, &bench.storage);
  reborn.Boot();
  EXPECT_EQ(reborn.table().size(), 3);
}

TEST(Store, MemoryThatKeepsSomethingElseNeverCostsTheGoodSlot) {
  RamStorage storage;
  Store store(&storage);
  ASSERT_TRUE(store.Write(Holding(1.0f), 1));
  storage.worn = true;
  for (std::uint32_t i = 2; i < 5; ++i) EXPECT_FALSE(store.Write(Holding(2.0f), i));
  Table table;
  std::uint32_t generation = 0;
  ASSERT_EQ(Store(&storage).Read(&table, &generation), Store::Load::kLoaded);
  EXPECT_FLOAT_EQ(table[0].zro_dps[0], 1.0f);
}

TEST(CorrectorStore, MergesAreCommittedAtMostOnceAnHour) {
  Config config;
  config.sample_hz = 50.0f;
  config.limits.min_samples = 250;
  Bench bench(config);
  bench.corrector().SetDate(15000);
  bench.AddFactory({10, 25, 40});
  const int before = bench.storage.writes;
  for (int still = 0; still < 200; ++still) {  // 2 h
    bench.Rest(30.0, 24.0 + 0.005 * still);
    bench.Shake(6.0, 24.0);
  }
  EXPECT_GE(bench.Count(Code::kMerged), 2);
  EXPECT_LE(bench.storage.writes - before, bench.Count(Code::kNew) + 2);
}

TEST(CorrectorStore, CommitWithoutChangeWritesNothing) {
  Bench bench;
  bench.AddFactory({25});
  EXPECT_EQ(bench.storage.writes, 1);
  EXPECT_TRUE(bench.corrector().Commit());
  EXPECT_EQ(bench.storage.writes, 1);
  EXPECT_EQ(bench.corrector().generation(), 1u);
}

}  // namespace
}  // namespace zro
