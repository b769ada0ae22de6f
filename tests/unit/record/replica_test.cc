#include "rig/record/replica.h"
#include "rig/record/replay/replay.h"

#include <cmath>
#include <random>

#include "tests/unit/record/record_fixture.h"

namespace zrobench::testing {
namespace {

using zro::node::Frame;
using zro::node::Node;

constexpr std::uint16_t kDivider = 10;

zro::Config Quick() { return zro::ConfigFor(200.0f, 0.005f); }

/// A board on a bus with a recorder: what it sends becomes items, in bus order.
class Board final : zro::node::FrameSink {
 public:
  std::vector<Item> items;

  explicit Board(std::span<const std::uint8_t> start_image) {
    EXPECT_TRUE(storage_.Load(start_image));
  }

  void Boot() {
    counter_ = 0;
    zro::node::FrameSink* const sink = this;
    node_.emplace(zro::node::Identity{1, 2, 3, 4, 5, 6}, Quick(), &storage_, sink, kDivider);
    node_->Boot(zro::node::BootReason::kPowerOn, 1);
  }
  void SendFrame(std::uint32_t id, std::vector<std::uint8_t> bytes) {
    BusFrame item{now_us_, id, static_cast<std::uint8_t>(bytes.size()), 1, {}};
    Frame frame{id, item.dlc, {}};
    std::copy(bytes.begin(), bytes.end(), item.data.begin());
    std::copy(bytes.begin(), bytes.end(), frame.data);
    items.push_back(item);
    node_->OnFrame(frame);
    if (node_->reset_requested()) Boot();
  }
  /// Rest at `degc` with the offset (0.5 + 0.01 degc, -1, 0) dps.
  void Rest(double seconds, double degc, double shake_g = 0.0005) {
    for (int i = 0; i < seconds * 200; ++i) {
      now_us_ += 5000;
      zro::node::RawSample raw{};
      const double lsb = 250.0 / 32768;
      const double dps[3] = {0.5 + 0.01 * degc, -1, 0};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        raw.gyro[axis] =
            static_cast<std::int16_t>(std::lround((dps[axis] + 0.05 * noise_(generator_)) / lsb));
        raw.accel[axis] = static_cast<std::int16_t>(
            std::lround(((axis == 2 ? 1 : 0) + shake_g * noise_(generator_)) * 8000));
      }
      raw.temperature = static_cast<std::int16_t>(std::lround(degc * 256));
      raw.counter = counter_++;
      raw.range_code = 1;
      node_->OnSample(raw);
    }
  }
  std::vector<std::uint8_t> Image() const {
    std::vector<std::uint8_t> image(zro::Table::kMaxImageBytes);
    image.resize(node_->corrector().table().ToImage(node_->corrector().generation(), image.data()));
    return image;
  }
  const Node& node() const { return *node_; }

 private:
  /// As the recorder's tap puts frames into items.
  void Send(const Frame& frame) override {
    zro::node::TimeMsg time{};
    zro::node::CorrMsg corr{};
    if (Decode(frame, &time)) {
      items.push_back(ImuTime{now_us_, time.sample_time_us, time.sample_seq, time.temperature});
    } else if (frame.id == zro::node::RawMsg::kId) {
      sample_ = ImuSample{};
      sample_.at_us = now_us_;
      std::memcpy(sample_.raw.data(), frame.data, 6);
      sample_.seq = frame.data[6];
      sample_.raw_flags = frame.data[7];
    } else if (frame.id == zro::node::AccMsg::kId) {
      std::memcpy(sample_.accel.data(), frame.data, 6);
      sample_.accel_flags = frame.data[7];
    } else if (frame.id == zro::node::RateMsg::kId) {
      std::memcpy(sample_.rate.data(), frame.data, 6);
      sample_.rate_flags = frame.data[7];
      items.push_back(sample_);
    } else if (Decode(frame, &corr)) {
      items.push_back(ImuCorrection{
          now_us_, {corr.corr[0], corr.corr[1], corr.corr[2]}, corr.bin, corr.state, corr.age_s});
    } else {
      BusFrame item{now_us_, frame.id, frame.dlc, 0, {}};
      std::copy_n(frame.data, 8, item.data.begin());
      items.push_back(item);
    }
  }

  RamStorage storage_;
  std::optional<Node> node_;
  std::mt19937 generator_{7};
  std::normal_distribution<double> noise_{0, 1};
  std::uint64_t now_us_ = 0;
  std::uint16_t counter_ = 0;
  ImuSample sample_;
};

/// A table of generation 3 with factory entries at 10 and 40 degC.
std::vector<std::uint8_t> FactoryImage() {
  zro::Corrector corrector(Quick(), nullptr);
  const float cold[3] = {0.6f, -1, 0}, warm[3] = {0.9f, -1, 0};
  corrector.AddFactoryEntry(10, cold, 0.005f);
  corrector.AddFactoryEntry(40, warm, 0.005f);
  std::vector<std::uint8_t> image(zro::Table::kMaxImageBytes);
  image.resize(corrector.table().ToImage(3, image.data()));
  return image;
}

constexpr std::uint32_t kSdo = 0x610;

/// A life with everything in it: learning, a date, motion, limits changed, a store, a reboot.
std::unique_ptr<Board> FullLife() {
  auto life = std::make_unique<Board>(FactoryImage());
  Board& board = *life;
  board.Boot();
  board.SendFrame(0x100, {0, 0, 0, 0, 0xED, 0x3B});
  board.Rest(12, 25);
  board.SendFrame(kSdo, {0x40, 0x18, 0x10, 4, 0, 0, 0, 0});              // serial number
  board.Rest(2, 25, 0.2);                                                // shaken
  board.SendFrame(kSdo, {0x23, 0x00, 0x21, 3, 0x0A, 0xD7, 0x23, 0x3C});  // max_step_dps = 0.01
  board.Rest(12, 31);
  board.SendFrame(kSdo, {0x23, 0x10, 0x10, 1, 's', 'a', 'v', 'e'});
  board.SendFrame(0x000, {129, 0x10});
  board.Rest(12, 31);
  board.SendFrame(kSdo, {0x40, 0x00, 0x20, 8, 0, 0, 0, 0});  // CRC-32 of the table
  return life;
}

std::unique_ptr<Replica> Fed(const std::vector<Item>& items,
                             const std::vector<std::uint8_t>& image = FactoryImage()) {
  auto replica = Replica::Create(Quick(), kDivider, image);
  EXPECT_TRUE(replica.has_value());
  for (const Item& item : items) {
    std::visit([&](const auto& concrete) { (*replica)->On(concrete); }, item);
  }
  return std::move(*replica);
}

TEST(ReplicaTest, RunsInLockstepWithTheBoard) {
  const auto life = FullLife();
  const Board& board = *life;
  const auto replica = Fed(board.items);
  EXPECT_EQ(replica->boots(), 2u);
  EXPECT_EQ(replica->lost_inputs(), 0u);
  EXPECT_EQ(replica->rates().equal, 200u * 38);
  for (const Lockstep* part :
       {&replica->rates(), &replica->corrections(), &replica->replies(), &replica->emergencies()}) {
    EXPECT_EQ(part->different, 0u) << std::hex << part->first_difference_id;
    EXPECT_GT(part->equal, 0u);
  }
  EXPECT_EQ(replica->TableImage(), board.Image());
  EXPECT_NE(replica->TableImage(), FactoryImage());
  EXPECT_GT(board.node().corrector().generation(), 3u);
}

TEST(ReplicaTest, GivesTheBoardsLogOfAllBoots) {
  const auto life = FullLife();
  const Board& board = *life;
  const auto replica = Fed(board.items);
  const std::uint32_t second = board.node().log().total();
  ASSERT_GT(replica->log().size(), second);
  zro::node::EventLog log = board.node().log();
  std::uint8_t bytes[zro::node::EventLog::kMaxRead * 24];
  const std::uint32_t n = log.Peek(bytes);
  ASSERT_EQ(n, second);
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto& ours = replica->log()[replica->log().size() - second + i];
    EXPECT_EQ(std::memcmp(ours.data(), bytes + 24 * i, 24), 0) << i;
  }
}

TEST(ReplicaTest, ABoardThatDoesSomethingElseIsFound) {
  const auto life = FullLife();
  Board& board = *life;
  std::size_t seen = 0;
  std::uint64_t at_us = 0;
  for (Item& item : board.items) {
    auto* sample = std::get_if<ImuSample>(&item);
    if (sample == nullptr || ++seen != 3000) continue;
    sample->rate[1] = static_cast<std::int16_t>(sample->rate[1] + 1);
    at_us = sample->at_us;
  }
  const auto replica = Fed(board.items);
  EXPECT_EQ(replica->rates().different, 1u);
  EXPECT_EQ(replica->rates().first_difference_us, at_us);
}

TEST(ReplicaTest, AnotherStartTableShowsInRatesAndReplies) {
  std::vector<std::uint8_t> blank(zro::Table::kHeaderBytes);
  blank[0] = 1;
  const auto replica = Fed(FullLife()->items, blank);
  EXPECT_GT(replica->rates().different, 0u);
  EXPECT_GT(replica->replies().different, 0u);
}

TEST(ReplicaTest, ALostSampleOrRequestIsCounted) {
  const auto life = FullLife();
  Board& board = *life;
  auto items = board.items;
  const auto samples = std::count_if(items.begin(), items.end(), [](const Item& item) {
    return std::holds_alternative<ImuSample>(item);
  });
  ASSERT_EQ(samples, 200 * 38);
  std::size_t seen = 0;
  std::erase_if(items, [&](const Item& item) {
    return std::holds_alternative<ImuSample>(item) && (++seen == 500 || seen == 501);
  });
  EXPECT_EQ(Fed(items)->lost_inputs(), 2u);
  items = board.items;
  std::erase_if(items, [](const Item& item) {
    const auto* frame = std::get_if<BusFrame>(&item);
    return frame != nullptr && frame->id == 0x590 && frame->data[2] == 0x10 &&
           frame->data[1] == 0x18;
  });
  EXPECT_EQ(Fed(items)->lost_inputs(), 1u);
}

TEST(ReplicaTest, AWriteWithoutTheBoardsReplyHasNoEffect) {
  Board board(FactoryImage());
  board.Boot();
  board.Rest(12, 25);
  auto items = board.items;
  items.push_back(BusFrame{1, kSdo, 8, 1, {0x23, 0x11, 0x10, 1, 'l', 'o', 'a', 'd'}});
  EXPECT_EQ(Fed(items)->TableImage(), board.Image());
  items.push_back(BusFrame{2, 0x590, 8, 0, {0x60, 0x11, 0x10, 1, 0, 0, 0, 0}});
  EXPECT_NE(Fed(items)->TableImage(), board.Image());
}

TEST(ReplicaTest, SamplesBeforeTheFirstBootCannotBeJudged) {
  const auto replica = Fed({ImuSample{.at_us = 1}});
  EXPECT_EQ(replica->lost_inputs(), 1u);
  EXPECT_EQ(replica->rates().equal + replica->rates().different, 0u);
  EXPECT_TRUE(replica->TableImage().empty());
}

TEST(ReplicaTest, ADamagedStartTableIsRefused) {
  EXPECT_FALSE(Replica::Create(Quick(), kDivider, std::vector<std::uint8_t>(5)).has_value());
}

class RecordReplayTest : public FolderTest {};

TEST_F(RecordReplayTest, ARecordBringsItsStartTableDatesAndBoots) {
  const auto life = FullLife();
  Board& board = *life;
  std::vector<Item> items = board.items;
  items.insert(items.begin() + 20, TableItem{0, 0, 0, FactoryImage()});
  Record(Path("record.ulg"), items);
  const auto image = StartImage(Path("record.ulg"));
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(*image, FactoryImage());
  const auto summary = Replay(Path("record.ulg"), {});
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  EXPECT_EQ(summary->samples, 200u * 38);
  EXPECT_NEAR(summary->config.sample_hz, 200, 1e-3);
  EXPECT_EQ(summary->final_table[0].origin, zro::Origin::kFactory);
  ASSERT_EQ(summary->final_table.size(), board.node().corrector().table().size());
  bool dated = false;
  for (int i = 0; i < summary->final_table.size(); ++i) {
    dated = dated || summary->final_table[i].date == 0x3BED;
  }
  EXPECT_TRUE(dated);
  // A run folder is as good as its record.
  const auto by_folder = Replay(folder_, {});
  ASSERT_TRUE(by_folder.has_value()) << by_folder.error().message;
  EXPECT_EQ(by_folder->samples, summary->samples);
}

TEST_F(RecordReplayTest, ARecordWithoutATableHasNoStartImage) {
  Record(Path("r.ulg"), {ImuSample{}});
  EXPECT_FALSE(StartImage(Path("r.ulg")).has_value());
  EXPECT_FALSE(Replay(Path("r.ulg"), {}).has_value());
}

}  // namespace
}  // namespace zrobench::testing
