#pragma once
// A bench of small fakes in virtual time, with a record in a folder that goes away.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "rig/record/item_reader.h"
#include "rig/run/bench_loop.h"

namespace zrobench {

struct FakePlate final : ThermalPlate {
  const Clock* clock = nullptr;
  double degc = 23, target_degc = 23;
  bool on = false, broken = false, cannot_stop = false;
  Result<Reading> Read(Instant) override {
    if (broken) return Fail(Error::Kind::kTimeout, "plate: no answer");
    if (on) degc = target_degc;
    return Reading{degc, target_degc, on ? 50.0 : 0.0, clock->now()};
  }
  Status SetTarget(double wanted_degc, Instant) override {
    on = true;
    target_degc = wanted_degc;
    return {};
  }
  Status MakeSafe(Instant) override {
    if (cannot_stop) return Fail(Error::Kind::kTimeout, "plate: will not stop");
    on = false;
    return {};
  }
};

struct FakeSpeaker final : Speaker {
  double hz = 0, v = 0, band_hz = 0;
  bool throws = false;
  bool sines_only = false;
  std::vector<double> played_hz, played_v;  ///< every change
  Status SetTone(double tone_hz, double tone_v, Instant) override {
    if (throws) throw std::logic_error("contract broken: speaker");
    hz = tone_hz;
    v = tone_v;
    band_hz = 0;
    played_hz.push_back(hz);
    return {};
  }
  bool plays_music() const override { return !sines_only; }
  Status SetMusic(double low_hz, double high_hz, double music_v, Instant deadline) override {
    if (sines_only) return Speaker::SetMusic(low_hz, high_hz, music_v, deadline);
    hz = (low_hz + high_hz) / 2;
    band_hz = high_hz - low_hz;
    v = music_v;
    played_v.push_back(v);
    return {};
  }
  Result<State> Read(Instant) override { return State{hz, v, v > 0}; }
  Status Mute(Instant) override {
    hz = v = 0;
    return {};
  }
};

struct FakePower final : Power {
  bool on = true;
  Status SetOn(bool wanted, Instant) override {
    on = wanted;
    return {};
  }
};

struct FakeHand final : Operator {
  bool there = true;
  std::vector<std::string> moves;
  Status StartMove(const std::string& how, Duration) override {
    if (!there) return Fail(Error::Kind::kRefused, "unattended");
    moves.push_back(how);
    return {};
  }
  bool moving() const override { return false; }
};

/// Alive unless told otherwise; boots when reset or when its supply comes back.
struct FakeBoard final : ImuBoard {
  const FakePower* power = nullptr;
  bool silent = false, was_on = true;
  BoardStatus state;
  std::uint32_t generation = 1;
  std::uint32_t forget_at_boots = 0;  ///< its table changes with each of so many boots
  int dates = 0;
  bool loads = true;  ///< has a load of its own
  double load_pct = 0;

  void Boot() {
    ++state.boots_seen;
    if (state.boots_seen <= forget_at_boots) ++generation;
  }
  Status Pump() override {
    if (power->on && !was_on) Boot();
    was_on = power->on;
    return {};
  }
  BoardStatus status() const override {
    BoardStatus now = state;
    now.alive = !silent && power->on;
    return now;
  }
  CanHealth link() const override { return {}; }
  Status Reset() override {
    Boot();
    return {};
  }
  Status SendDate(UtcNs) override {
    ++dates;
    return {};
  }
  Status SendHeartbeat() override { return {}; }
  Result<TableSnapshot> ReadTable(Instant) override {
    TableSnapshot snapshot;
    snapshot.image.resize(zro::Table::kMaxImageBytes);
    snapshot.image.resize(snapshot.table.ToImage(generation, snapshot.image.data()));
    return snapshot;
  }
  Result<std::vector<std::array<std::uint8_t, 24>>> ReadNewLogRecords(Instant) override {
    return std::vector<std::array<std::uint8_t, 24>>{};
  }
  Status StoreTable(Instant) override { return {}; }
  Status RestoreFactory(Instant) override { return {}; }
  Status SetLoad(double pct, Instant) override {
    if (!loads) return Fail(Error::Kind::kRefused, "object 0x2101:6: no such sub-index");
    load_pct = pct;
    return {};
  }
  Status DownloadFactoryEntry(double, const std::array<double, 3>&, double, Instant) override {
    return {};
  }
};

class BenchTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "zrobench-run-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    recorder_ = std::move(*Recorder::Create(folder_ / "record.ulg", 0, {}));
    log_.emplace(*recorder_, clock_, nullptr);
    plate_.clock = &clock_;
    board_.power = &power_;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void Pass(double seconds) { clock_.Wait(clock_.now() + FromSeconds(seconds), {}); }
  /// What the bus would have shown.
  void BoardIsAt(double degc) {
    log_->Write(ImuTime{log_->now_us(), 0, 0, static_cast<std::int16_t>(degc * 256)});
  }
  /// Every item of one type, as recorded so far.
  template <typename T>
  std::vector<T> Recorded() {
    EXPECT_TRUE(recorder_->Flush());
    std::vector<T> items;
    const auto end = ReadItems(folder_ / "record.ulg", [&]<typename Item>(const Item& item) {
      if constexpr (std::is_same_v<Item, T>) items.push_back(item);
    });
    EXPECT_TRUE(end);
    return items;
  }
  /// Texts of the events of one kind.
  std::vector<std::string> Events(EventItem::Kind kind) {
    std::vector<std::string> texts;
    for (const EventItem& event : Recorded<EventItem>()) {
      if (event.kind == kind) texts.push_back(event.text);
    }
    return texts;
  }

  std::filesystem::path folder_;
  VirtualClock clock_{0};
  std::unique_ptr<Recorder> recorder_;
  std::optional<RunLog> log_;
  FakePlate plate_;
  FakeSpeaker speaker_;
  FakePower power_;
  FakeHand hand_;
  FakeBoard board_;
  Bench bench_{{clock_, plate_, speaker_, &power_, nullptr, &hand_}, board_};
  Station station_;
  StopRequest stop_;
};

}  // namespace zrobench
