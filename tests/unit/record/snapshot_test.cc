#include "rig/record/snapshot.h"

#include <cmath>

#include "corrector/corrector.h"
#include "corrector/node/event_log.h"
#include "rig/record/decision.h"
#include "tests/unit/record/record_fixture.h"

namespace zrobench::testing {
namespace {

using Kind = EventItem::Kind;

EventItem Event(std::uint64_t at_us, Kind kind, const std::string& text = {}) {
  EventItem event;
  event.at_us = at_us;
  event.kind = kind;
  event.text = text;
  return event;
}

BusFrame Emergency(std::uint64_t at_us, zro::Code code, std::int16_t measured_lsb = 0) {
  BusFrame frame{at_us, 0x90, 8, 0, {}};
  frame.data[3] = static_cast<std::uint8_t>(code);
  frame.data[4] = 1 | 63 << 2;  // axis y, no bin
  frame.data[5] = static_cast<std::uint8_t>(measured_lsb & 0xFF);
  frame.data[6] = static_cast<std::uint8_t>(measured_lsb >> 8);
  return frame;
}

LogItem Log(zro::Code code, std::uint32_t seq = 1) {
  zro::Event event{seq, 100, code, 2, 10, 25.5f, {0.5f, -0.25f, 1.0f}, 0.5f, 2.0f};
  LogItem item;
  zro::node::PackLogRecord(event, 123456, item.bytes.data());
  return item;
}

TEST(SnapshotTest, CountsSamplesLossesAndRate) {
  RunSnapshot s;
  for (std::uint64_t i = 0; i < 450; ++i) {
    if (i == 300 || i == 301) continue;  // two lost, across the wrap of the sequence byte as well
    ImuSample sample;
    sample.at_us = i * 5000;
    sample.seq = static_cast<std::uint8_t>(i);
    sample.rate_flags = 0x14;
    Reduce(s, sample);
  }
  EXPECT_EQ(s.samples, 448u);
  EXPECT_EQ(s.lost, 2u);
  EXPECT_NEAR(s.imu_hz, 200.0, 2.5);
  EXPECT_TRUE(s.still);
  EXPECT_TRUE(s.learning);
  EXPECT_FALSE(s.vibration);
}

TEST(SnapshotTest, ARebootIsNoLoss) {
  RunSnapshot s;
  Reduce(s, ImuSample{.at_us = 1, .seq = 200});
  Reduce(s, BusFrame{2, 0x710, 1, 0, {0}});
  Reduce(s, ImuSample{.at_us = 3, .seq = 0});
  EXPECT_EQ(s.lost, 0u);
  EXPECT_EQ(s.boots, 1u);
  Reduce(s, BusFrame{4, 0x710, 1, 0, {5}});  // a plain heartbeat
  EXPECT_EQ(s.boots, 1u);
}

TEST(SnapshotTest, ARejectionIsExpectedWhileAStimulusIsOpenOrJustOver) {
  RunSnapshot s;
  Reduce(s, Emergency(1'000'000, zro::Code::kMotion, 256));
  Reduce(s, Event(2'000'000, Kind::kStimulusBegin, "tone"));
  Reduce(s, ImuTime{2'500'000, 0, 0, 30 * 256});
  Reduce(s, Emergency(3'000'000, zro::Code::kAcousticOrVibration, -512));
  Reduce(s, Event(4'000'000, Kind::kStimulusEnd, "tone"));
  Reduce(s, Emergency(4'000'000 + RunSnapshot::kStimulusEchoUs, zro::Code::kGyroVariance));
  Reduce(s, Emergency(4'000'001 + RunSnapshot::kStimulusEchoUs, zro::Code::kGyroVariance));
  ASSERT_EQ(s.rejections.size(), 4u);
  EXPECT_FALSE(s.rejections[0].expected);
  EXPECT_TRUE(s.rejections[1].expected);
  EXPECT_TRUE(s.rejections[2].expected);
  EXPECT_FALSE(s.rejections[3].expected);
  EXPECT_EQ(s.rejections[1].code, zro::Code::kAcousticOrVibration);
  EXPECT_EQ(s.rejections[1].measured_dps, -2.0);
  EXPECT_EQ(s.rejections[1].imu_degc, 30.0);
  EXPECT_EQ(s.rejections[1].axis, 1);
  EXPECT_EQ(s.expected_rejections, 2u);
  EXPECT_EQ(s.unexpected_rejections, 2u);
}

TEST(SnapshotTest, OfTwoOpenStimuliOneEnds) {
  RunSnapshot s;
  Reduce(s, Event(1, Kind::kStimulusBegin, "tone"));
  Reduce(s, Event(2, Kind::kStimulusBegin, "move"));
  Reduce(s, Event(3, Kind::kStimulusEnd, "tone"));
  EXPECT_EQ(s.stimuli, std::vector<std::string>{"move"});
}

TEST(SnapshotTest, OnlyTheLastRejectionsAreKept) {
  RunSnapshot s;
  for (std::uint64_t i = 0; i < 100; ++i) Reduce(s, Emergency(i, zro::Code::kMotion));
  EXPECT_EQ(s.rejections.size(), RunSnapshot::kKeptRejections);
  EXPECT_EQ(s.rejections.back().at_us, 99u);
  EXPECT_EQ(s.unexpected_rejections, 100u);
}

TEST(SnapshotTest, StepsAlarmsAndEnd) {
  RunSnapshot s;
  EventItem start = Event(1, Kind::kRunStart, "smoke");
  start.a = 12;
  Reduce(s, start);
  EventItem step = Event(2, Kind::kStepBegin, "ramp to 45 degc");
  step.step = 6;
  Reduce(s, step);
  Reduce(s, Event(3, Kind::kAlarm, "plate silent"));
  EventItem off = Event(4, Kind::kPower);
  Reduce(s, off);
  EXPECT_EQ(s.profile, "smoke");
  EXPECT_EQ(s.step_count, 12);
  EXPECT_EQ(s.step, 6);
  EXPECT_EQ(s.step_text, "ramp to 45 degc");
  EXPECT_EQ(s.step_began_us, 2u);
  EXPECT_EQ(s.alarm_count, 1u);
  EXPECT_EQ(s.alarms.at(0).text, "plate silent");
  EXPECT_FALSE(s.powered);
  EXPECT_FALSE(s.ended);
  Reduce(s, Event(5, Kind::kRunEnd, "done"));
  EXPECT_TRUE(s.ended);
  EXPECT_EQ(s.at_us, 5u);
}

TEST(SnapshotTest, DecisionsAreCountedByCodeAndDamagedRecordsApart) {
  RunSnapshot s;
  Reduce(s, Log(zro::Code::kNew));
  Reduce(s, Log(zro::Code::kNew));
  Reduce(s, Log(zro::Code::kMotion));
  LogItem damaged = Log(zro::Code::kNew);
  damaged.bytes[10] ^= 1;
  Reduce(s, damaged);
  EXPECT_EQ(s.decisions.at(zro::Code::kNew), 2u);
  EXPECT_EQ(s.decisions.at(zro::Code::kMotion), 1u);
  EXPECT_EQ(s.damaged_log_records, 1u);
}

TEST(SnapshotTest, ALogRecordComesBackInUnits) {
  const auto decision = ParseDecision(Log(zro::Code::kMerged, 77).bytes);
  ASSERT_TRUE(decision.has_value());
  EXPECT_EQ(decision->seq, 77u);
  EXPECT_EQ(decision->device_us, 123456u);
  EXPECT_EQ(decision->axis, 2);
  EXPECT_EQ(decision->bin, 10);
  EXPECT_EQ(decision->temp_degc, 25.5);
  EXPECT_EQ(decision->measured_dps, (std::array{0.5, -0.25, 1.0}));
  EXPECT_EQ(decision->limit, 0.5);
  EXPECT_EQ(decision->value, 2.0);
}

TableItem LearnedTable() {
  zro::Corrector corrector(zro::Config{}, nullptr);
  const float zro_dps[3] = {0.5f, -1.25f, 0.125f};
  corrector.AddFactoryEntry(25.0f, zro_dps, 0.01f);
  corrector.AddFactoryEntry(40.0f, zro_dps, 0.01f);
  TableItem item{.at_us = 9, .when = 0, .crc32 = 1234, .image = {}};
  item.image.resize(zro::Table::kMaxImageBytes);
  item.image.resize(corrector.table().ToImage(5, item.image.data()));
  return item;
}

TEST(SnapshotTest, TheTableIsReadFromItsImage) {
  RunSnapshot s;
  Reduce(s, LearnedTable());
  ASSERT_EQ(s.table.size(), 2);
  EXPECT_EQ(s.table[1].temp_degc, 40.0f);
  EXPECT_EQ(s.table[0].zro_dps[1], -1.25f);
  EXPECT_EQ(s.table_generation, 5u);
  TableItem damaged = LearnedTable();
  damaged.image.pop_back();
  Reduce(s, damaged);
  EXPECT_EQ(s.table.size(), 2);
}

RunSnapshot Rich() {
  RunSnapshot s;
  for (const Item& item : OneOfEach()) Reduce(s, item);
  Reduce(s, LearnedTable());
  Reduce(s, Log(zro::Code::kNew));
  Reduce(s, Emergency(20, zro::Code::kMotion));
  Reduce(s, Event(21, Kind::kAlarm, "plate \"silent\"\n\xFF"));
  return s;
}

TEST(SnapshotTest, JsonGivesTheSameStateAndFoldsOnAlike) {
  RunSnapshot s = Rich();
  auto back = SnapshotFromJson(ToJson(s));
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(back->table.size(), 2);
  EXPECT_EQ(back->rejections.size(), 1u);
  EXPECT_EQ(back->plate_degc, 44.5);
  for (RunSnapshot* each : {&s, &*back}) {
    for (const Item& item : OneOfEach()) Reduce(*each, item);
  }
  EXPECT_EQ(ToJson(s), ToJson(*back));
}

TEST(SnapshotTest, JsonStandsWhatIsNoNumber) {
  RunSnapshot s;
  s.plate_degc = std::nan("");
  const auto back = SnapshotFromJson(ToJson(s));
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_TRUE(std::isnan(back->plate_degc));
}

TEST(SnapshotTest, ForeignJsonIsRefused) {
  for (const char* text : {"", "{}", "[1]", R"({"schema":2})", R"({"schema":1,"step":"x"})",
                           R"({"schema":1,"table":"zz"})"}) {
    EXPECT_FALSE(SnapshotFromJson(text).has_value()) << text;
  }
}

TEST(SnapshotTest, ALateReaderBeginsAtASnapshot) {
  const RunSnapshot s = Rich();
  RunSnapshot late;
  Reduce(late, SnapshotItem{30, ToJson(s)});
  EXPECT_EQ(ToJson(late), ToJson(s));
  // A reader that was there from the start keeps its own.
  RunSnapshot own;
  Reduce(own, ImuSample{.at_us = 5});
  Reduce(own, SnapshotItem{30, ToJson(s)});
  EXPECT_EQ(own.samples, 1u);
}

}  // namespace
}  // namespace zrobench::testing
