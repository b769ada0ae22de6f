// Sweeps, music and loads as a report tells them.
#include <gmock/gmock.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "corrector/node/event_log.h"
#include "rig/record/recorder.h"
#include "rig/report/history.h"
#include "rig/report/plots.h"
#include "rig/report/sections.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::SizeIs;

class SoundRecord : public testing::Test {
 protected:
  SoundRecord()
      : path_(std::filesystem::temp_directory_path() /
              ("zrobench-sound-" + std::to_string(::getpid()) + ".ulg")) {
    std::filesystem::remove(path_);
    recorder_ = std::move(*Recorder::Create(path_, 0, {}));
  }
  ~SoundRecord() override { std::filesystem::remove(path_); }

  static std::uint64_t At(double t_s) { return static_cast<std::uint64_t>(t_s * 1e6); }
  void Speaker(double t_s, double hz, double spl_db, double band_hz = 0) {
    recorder_->Write(SpeakerItem{At(t_s), hz, hz > 0 ? 1.0 : 0.0, spl_db, band_hz});
  }
  void LoadOf(double t_s, double pct) {
    recorder_->Write(EventItem{At(t_s), EventItem::Kind::kLoad, 0, pct, 0, "load"});
  }
  void Decide(double t_s, zro::Code code) {
    recorder_->Write(ImuTime{At(t_s), static_cast<std::uint32_t>(At(t_s)), 0, 25 * 256});
    LogItem item{At(t_s), {}};
    const zro::Event event{++seq_, 0, code, 2, 25, 25.0f, {0.8f, -1.1f, 0.35f}, 0, 0};
    zro::node::PackLogRecord(event, static_cast<std::uint32_t>(At(t_s)), item.bytes.data());
    recorder_->Write(item);
  }
  History Read() {
    EXPECT_TRUE(recorder_->Close());
    return ReadHistory(path_).value();
  }

  std::filesystem::path path_;
  std::unique_ptr<Recorder> recorder_;
  std::uint32_t seq_ = 0;
};

TEST_F(SoundRecord, MusicIsOneRowAtItsLoudestAndASweepOneATone) {
  Speaker(10, 30000, 107, 7000);
  Speaker(12, 30000, 113, 7000);
  Speaker(14, 30000, 93, 7000);
  Speaker(16, 0, 0);
  Speaker(20, 26900, 100);
  Speaker(27, 27000, 100);
  Speaker(34, 0, 0);
  const History h = Read();
  ASSERT_THAT(h.tones, SizeIs(3));
  EXPECT_EQ(h.tones[0].band_hz, 7000);
  EXPECT_EQ(h.tones[0].spl_db, 113);
  EXPECT_DOUBLE_EQ(h.tones[0].from_s, 10);
  EXPECT_DOUBLE_EQ(h.tones[0].to_s, 16);
  EXPECT_EQ(h.tones[1].hz, 26900);
  EXPECT_DOUBLE_EQ(h.tones[1].to_s, 27);
  EXPECT_EQ(h.tones[2].hz, 27000);
  EXPECT_THAT(TonesHtml(h), HasSubstr("<td>26500–33500</td><td>113</td>"));
}

TEST_F(SoundRecord, AReadingBelongsToTheToneThatWasItsLongestPart) {
  Speaker(20, 26900, 100);
  Speaker(27, 27000, 100);
  Decide(28, zro::Code::kMerged);  // 23 to 28 s: four of five seconds of the first tone
  Decide(33, zro::Code::kAcousticOrVibration);
  Speaker(34, 0, 0);
  Decide(38.4, zro::Code::kAcousticOrVibration);  // half a second of sound
  Decide(50, zro::Code::kNew);                    // none
  const History h = Read();
  ASSERT_THAT(h.tones, SizeIs(2));
  EXPECT_THAT(h.tones[0].decisions, ElementsAre(Pair(zro::Code::kMerged, 1)));
  EXPECT_THAT(h.tones[1].decisions, ElementsAre(Pair(zro::Code::kAcousticOrVibration, 2)));
  EXPECT_THAT(TonesHtml(h), HasSubstr("2 × 10"));
  const auto plots = nlohmann::json::parse(PlotsJson(h));
  EXPECT_THAT(plots["tones"][1]["decisions"].get<std::string>(), HasSubstr("2 × 10"));
}

TEST_F(SoundRecord, EveryToneOfASweepIsMeasuredAgainstTheSilenceBeforeIt) {
  for (int t = 1; t <= 40; ++t) {
    const float z = t <= 20 ? 0.01f : t <= 30 ? 0.11f : 0.31f;
    recorder_->Write(MeanItem{At(t), 25, {0, 0, z}, {0, 0, z}, {0, 0, 1}, 200});
    if (t == 20) {
      recorder_->Write(
          EventItem{At(20), EventItem::Kind::kStimulusBegin, 0, 0, 100, "sweep 1-2 Hz"});
      Speaker(20, 26900, 100);
    }
    if (t == 30) Speaker(30, 27000, 100);
  }
  Speaker(40, 0, 0);
  const History h = Read();
  ASSERT_THAT(h.tones, SizeIs(2));
  EXPECT_NEAR(h.tones[0].shift_dps[2], 0.1, 1e-6);
  EXPECT_NEAR(h.tones[1].shift_dps[2], 0.3, 1e-6);
}

TEST_F(SoundRecord, LoadsAreStretchesOfTheirOwnAndNoStimuli) {
  LoadOf(10, 20);
  LoadOf(40, 0);
  LoadOf(50, 60);
  Decide(60, zro::Code::kTemperatureSlope);
  const History h = Read();
  ASSERT_THAT(h.loads, SizeIs(2));
  EXPECT_EQ(h.loads[0].duty_pct, 20);
  EXPECT_DOUBLE_EQ(h.loads[0].to_s, 40);
  EXPECT_DOUBLE_EQ(h.loads[1].from_s, 50);
  EXPECT_DOUBLE_EQ(h.loads[1].to_s, 60) << "the record's end";
  EXPECT_THAT(h.stimuli, SizeIs(0));
  EXPECT_EQ(h.readings.at(0).stimulus, -1);
  const auto plots = nlohmann::json::parse(PlotsJson(h));
  EXPECT_EQ(plots["loads"][1]["kind"], "load 60 %");
}

}  // namespace
}  // namespace zrobench
