#pragma once
// A minute of a bench by hand, so that every figure of a report can be foretold.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "corrector/node/event_log.h"
#include "rig/record/recorder.h"

namespace zrobench {

/// Bench seconds are counted from kStart_us. The board's temperature rises from 20 degC by 0.2
/// degC/s; set points 20 and 31 degC. A tone from 20 to 25 s turns z by 0.3 dps. The supply is off
/// from 40 to 42 s. The board's clock wraps in the first seconds.
class SmallRecord {
 public:
  static constexpr std::uint64_t kStart_us = 5'000'000;
  static constexpr std::uint32_t kBoot_us = 0xFFFFFFFFu - 2'000'000u;  ///< board's clock at 0 s

  /// `tone`: the stimulus's name, as the record holds it.
  explicit SmallRecord(std::string tone = "tone")
      : path_(std::filesystem::temp_directory_path() /
              ("zrobench-report-" + std::to_string(::getpid()) + ".ulg")),
        tone_(std::move(tone)) {
    std::filesystem::remove(path_);
    auto recorder = Recorder::Create(path_, kStart_us, {});
    if (!recorder) throw std::runtime_error(recorder.error().message);
    recorder_ = std::move(*recorder);
    recorder_->Write(PlateItem{At(0), 99, 23, 0, 23});  // what somebody else left
    Event(0, EventItem::Kind::kRunStart, "small");
    Event(0, EventItem::Kind::kStepBegin, "ramp to 31 degc");
    for (int t = 1; t <= 60; ++t) WriteSecond(t);
    WriteTable();
    if (auto closed = recorder_->Close(); !closed) throw std::runtime_error(closed.error().message);
  }
  SmallRecord(const SmallRecord&) = delete;
  SmallRecord& operator=(const SmallRecord&) = delete;
  ~SmallRecord() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  static std::uint64_t At(double t_s) {
    return kStart_us + static_cast<std::uint64_t>(std::llround(t_s * 1e6));
  }
  void Event(double t_s, EventItem::Kind kind, std::string text, double a = 0, double b = 0) {
    recorder_->Write(EventItem{At(t_s), kind, 0, a, b, std::move(text)});
  }
  void Log(double read_s, std::uint32_t device_us, const zro::Event& event) {
    LogItem item{At(read_s), {}};
    zro::node::PackLogRecord(event, device_us, item.bytes.data());
    recorder_->Write(item);
  }
  void WriteSecond(int t) {
    using Kind = EventItem::Kind;
    const auto degc = static_cast<float>(20 + 0.2 * t);
    if (t == 20) {
      Event(20, Kind::kStimulusBegin, tone_, 27000, 100);
      recorder_->Write(SpeakerItem{At(20), 27000, 2, 100});
    }
    if (t == 40) Event(40, Kind::kPower, "", 0);
    if (t == 42) Event(42, Kind::kPower, "", 1);
    if (t == 43) recorder_->Write(BusFrame{At(43), 0x710, 1, 0, {}});  // boot-up
    if (t == 43) {  // read before the board's new clock was seen
      Log(43, 500'000u, {1, 0, zro::Code::kReArmed, 3, 63, 28.6f, {0, 0, 0}, 0, 0});
    }
    recorder_->Write(PlateItem{At(t), t < 50 ? 20.0 : 31.0, degc + 0.5, 10, 23});
    if (t < 40 || t > 42) {
      const std::uint32_t second = 1'000'000u * static_cast<std::uint32_t>(t);
      recorder_->Write(ImuTime{At(t), t < 40 ? kBoot_us + second : second - 43'000'000u, 0,
                               static_cast<std::int16_t>(std::lround(degc * 256))});
      const float sound = t > 20 && t <= 25 ? 0.3f : 0.0f;
      recorder_->Write(MeanItem{At(t),
                                degc,
                                {0.8f, -1.1f, 0.35f + sound},
                                {0.001f, 0.002f, 0.003f + sound},
                                {0, 0, 1},
                                100});
    }
    if (t == 25) {
      recorder_->Write(SpeakerItem{At(25), 0, 0, 0});
      Event(25, Kind::kStimulusEnd, tone_);
    }
    if (t == 30) {  // read late: taken at 15 s and 24.5 s
      Log(30, kBoot_us + 15'000'000u,
          {1, 0, zro::Code::kNew, 3, 25, 23.0f, {0.8f, -1.1f, 0.35f}, 0, 0});
      Log(30, kBoot_us + 24'500'000u,
          {2, 0, zro::Code::kGyroVariance, 2, 25, 24.5f, {0.8f, -1.1f, 0.65f}, 2.5f, 4.5f});
      recorder_->Write(LogItem{At(30), {1, 2, 3}});  // damaged: its CRC is wrong
    }
    if (t == 50) Event(50, Kind::kAlarm, "plate <does> not answer");
    if (t == 58) {  // after the boot: taken at 55 s
      Log(58, 12'000'000u, {3, 0, zro::Code::kMotion, 1, 63, 31.0f, {0, 0, 0}, 0.015f, 0.2f});
    }
  }
  void WriteTable() {
    zro::Table table;
    table.Insert({21.0f, {0.8f, -1.1f, 0.35f}, 0.002f, 0, 1, zro::Origin::kFactory});
    table.Insert({23.0f, {0.8f, -1.1f, 0.35f}, 0.001f, 0, 3, zro::Origin::kLearned});
    TableItem item{At(60), 3, 0, {}};
    item.image.resize(zro::Table::kMaxImageBytes);
    item.image.resize(table.ToImage(1, item.image.data()));
    recorder_->Write(item);
  }

  std::filesystem::path path_;
  std::string tone_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace zrobench
