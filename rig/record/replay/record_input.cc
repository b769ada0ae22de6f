// Replay of a record of ours: the bus's integers, its dates and boots.
#include <fmt/format.h>

#include "corrector/node/codec.h"
#include "rig/record/item_reader.h"
#include "rig/record/replay/replay_input.h"
#include "rig/record/sample_counter.h"

namespace zrobench {
namespace {

constexpr std::size_t kSurveySteps = 20000;

class RecordInput final : public ReplayInput {
 public:
  explicit RecordInput(std::filesystem::path path) : path_(std::move(path)) {}

  Status Survey() {
    std::vector<double> steps_s;
    std::optional<ImuTime> last;
    const auto end = ReadItems(path_, [&]<typename T>(const T& item) {
      if constexpr (std::is_same_v<T, ImuTime>) {
        if (last && steps_s.size() < kSurveySteps) AddStep(steps_s, *last, item);
        last = item;
      } else if constexpr (std::is_same_v<T, TableItem>) {
        if (!start_image_) start_image_ = item.image;
      }
    });
    if (!end) return Fail(Error::Kind::kConfig, end.error().message);
    const auto rate = SampleRate(path_, std::move(steps_s));
    if (!rate) return tl::unexpected(rate.error());
    sample_hz_ = *rate;
    return {};
  }

  Status Feed(ReplaySink& sink) override {
    auto reader = ItemReader::Open(path_);
    if (!reader) return Fail(Error::Kind::kConfig, reader.error().message);
    Feeder feeder{sink};
    reader->Drain([&](const auto& item) { feeder.On(item); });
    return {};
  }

 private:
  /// Seconds a sample by the board's own clock: host stamps jitter.
  static void AddStep(std::vector<double>& steps_s, const ImuTime& a, const ImuTime& b) {
    const auto samples = static_cast<std::uint16_t>(b.counter - a.counter);
    if (samples > 0 && b.device_us > a.device_us) {
      steps_s.push_back((b.device_us - a.device_us) * 1e-6 / samples);
    }
  }

  /// An expedited download to 0x1010.
  static bool IsStoreRequest(const BusFrame& item) {
    return item.data[0] == 0x23 && item.data[1] == 0x10 && item.data[2] == 0x10;
  }

  struct Feeder {
    ReplaySink& sink;
    SampleCounter counter{};
    std::int16_t temperature = 0;
    std::uint16_t last_counter = 0;
    bool first = true, stopped = false;

    void On(const ImuTime& item) {
      counter.Take(item);
      temperature = item.temperature;
    }
    void On(const ImuSample& item) {
      const std::uint16_t now = counter.Take(item);
      const auto sample = zro::node::ToSample(ToRaw(item, now, temperature), last_counter, first);
      last_counter = now;
      first = false;
      if (!stopped) stopped = !sink.OnSample(static_cast<double>(item.at_us) * 1e-6, sample);
    }
    void On(const BusFrame& item) {
      if (item.own && item.id == zro::node::TimeStampMsg::kId) {
        sink.OnDate(static_cast<std::uint16_t>(item.data[4] | item.data[5] << 8));
      } else if (item.own && item.id == zro::node::SdoMsg::kRxId && IsStoreRequest(item)) {
        sink.OnStore();
      } else if (!item.own && item.id == zro::node::HeartbeatMsg::kNodeId && item.data[0] == 0) {
        if (!first) sink.OnBoot();
        first = true;
        counter = {};
      }
    }
    template <typename T>
    void On(const T&) {}
  };

  std::filesystem::path path_;
};

}  // namespace

Result<std::unique_ptr<ReplayInput>> OpenRecordInput(const std::filesystem::path& ulog) {
  auto input = std::make_unique<RecordInput>(ulog);
  if (Status status = input->Survey(); !status) return tl::unexpected(status.error());
  return input;
}

}  // namespace zrobench
