#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "corrector/zro_corrector.h"
#include "tests/unit/corrector/bench.h"

namespace zro {
namespace {

struct Flash {
  std::array<std::array<std::uint8_t, ZRO_SLOT_BYTES>, 2> slots;
  int writes = 0;
  Flash() {
    for (auto& slot : slots) slot.fill(0xFF);
  }
  static bool Read(void* context, int slot, std::uint8_t* out, std::size_t size) {
    std::memcpy(out, static_cast<Flash*>(context)->slots[static_cast<std::size_t>(slot)].data(),
                size);
    return true;
  }
  static bool Write(void* context, int slot, const std::uint8_t* bytes, std::size_t size) {
    auto* flash = static_cast<Flash*>(context);
    ++flash->writes;
    std::memcpy(flash->slots[static_cast<std::size_t>(slot)].data(), bytes, size);
    return true;
  }
  zro_storage Face() { return {this, Read, Write}; }
};

zro_sample AsC(const Sample& s) {
  zro_sample c;
  std::memcpy(&c, &s, sizeof c);
  return c;
}

TEST(CApi, IsTheSameCorrectorBitForBit) {
  test::Bench bench(ConfigFor(200.0f, 0.005f));
  Flash flash;
  const zro_storage storage = flash.Face();
  zro_corrector c;
  zro_init(&c, 200.0f, 0.005f, &storage);
  bench.corrector().SetDate(15000);
  zro_set_date(&c, 15000);
  const float zro_dps[3] = {0.8f, -1.1f, 0.35f};
  bench.corrector().AddFactoryEntry(25.0f, zro_dps, 0.01f);
  ASSERT_TRUE(zro_add_factory_entry(&c, 25.0f, zro_dps, 0.01f));
  bench.corrector().Commit();
  ASSERT_TRUE(zro_commit(&c));
  for (int i = 0; i < 200 * 30; ++i) {
    const Sample sample = bench.Make(test::Scene{25.0 + i * 1e-4});
    const Output expected = bench.Step(sample);
    const zro_sample in = AsC(sample);
    zro_output out;
    zro_step(&c, &in, &out);
    ASSERT_EQ(std::memcmp(&out, &expected, sizeof out), 0) << i;
    zro_event event;
    while (zro_pop_event(&c, &event)) {
      ASSERT_EQ(event.code, static_cast<std::uint8_t>(bench.events.at(event.seq).code));
      ASSERT_EQ(event.sample, bench.events[event.seq].sample);
      ASSERT_EQ(event.value, bench.events[event.seq].value);
    }
  }
  ASSERT_GE(bench.Count(Code::kNew), 1);
  EXPECT_EQ(flash.writes, bench.storage.writes);
  EXPECT_EQ(std::memcmp(flash.slots[0].data(), bench.storage.slots[0].data(), ZRO_SLOT_BYTES), 0);
}

/// Rests at 25 degC with this offset on x; the offset then subtracted.
float Learned(zro_corrector* c, float offset_dps) {
  zro_output out{};
  for (int i = 0; i < 100 * 10; ++i) {
    const float noise = i % 2 == 0 ? 0.05f : -0.05f;
    const zro_sample s{
        {offset_dps + noise, noise, -noise}, {0, 0, 1}, 25.0f, 1, false, false, false};
    zro_step(c, &s, &out);
  }
  return out.zro_dps[0];
}

TEST(CApi, GyrosOfOneProgramDoNotKnowOfEachOther) {
  std::vector<zro_corrector> gyros(3);
  for (zro_corrector& gyro : gyros) zro_init(&gyro, 100.0f, 0.005f, nullptr);
  for (std::size_t i = 0; i < gyros.size(); ++i) {
    EXPECT_NEAR(Learned(&gyros[i], 0.5f * static_cast<float>(i)), 0.5f * static_cast<float>(i),
                1e-3f);
  }
}

TEST(CApi, ARebootFindsWhatWasStoredAndRestoreDropsIt) {
  Flash flash;
  const zro_storage storage = flash.Face();
  zro_corrector before;
  zro_init(&before, 100.0f, 0.005f, &storage);
  Learned(&before, 0.7f);
  ASSERT_TRUE(zro_commit(&before));
  zro_corrector after;
  zro_init(&after, 100.0f, 0.005f, &storage);
  const zro_sample s{{0, 0, 0}, {0, 0, 1}, 25.0f, 1, false, false, false};
  zro_output out;
  zro_step(&after, &s, &out);
  EXPECT_NEAR(out.zro_dps[0], 0.7f, 1e-3f);
  EXPECT_NEAR(out.rate_dps[0], -0.7f, 1e-3f);
  ASSERT_TRUE(zro_restore_factory(&after));
  zro_step(&after, &s, &out);
  EXPECT_EQ(out.zro_dps[0], 0.0f);
}

}  // namespace
}  // namespace zro
