// Replay of a CSV whose rows are instants.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "rig/record/replay/csv_source.h"
#include "rig/record/replay/replay_input.h"

namespace zrobench {
namespace {

constexpr std::array kGyro = {Channel::kGyroX, Channel::kGyroY, Channel::kGyroZ};
constexpr std::array kAccel = {Channel::kAccelX, Channel::kAccelY, Channel::kAccelZ};
constexpr double kHoldS = 5;         ///< a blank temperature stands for the last one
constexpr double kGapPeriods = 2.5;  ///< below is a logger's jitter
// Where the map states the rate, stamps are the host's and come in bursts: rows are consecutive
// unless a stamp runs this far ahead of the count.
constexpr double kBurstS = 0.5;
constexpr double kFollow = 1e-3;  ///< share of the difference that the count takes up a row
constexpr std::size_t kSurveySteps = 20000;

bool AnyBlank(const Row& row, std::span<const Channel> channels) {
  return std::any_of(channels.begin(), channels.end(),
                     [&](Channel channel) { return std::isnan(row[channel]); });
}

/// Makes samples of rows: holds what is not sampled at each row, counts the periods between rows.
class RowSampler {
 public:
  RowSampler(double sample_hz, bool rate_is_stated)
      : sample_hz_(sample_hz), rate_is_stated_(rate_is_stated) {}

  /// Nothing for a row without a gyro reading, or without any acceleration yet.
  std::optional<zro::Sample> Take(const Row& row) {
    Hold(row);
    if (AnyBlank(row, kGyro) || !has_accel_) return std::nullopt;
    const double t_s = row[Channel::kTime];
    zro::Sample sample{};
    for (std::size_t i = 0; i < 3; ++i) {
      sample.rate_dps[i] = static_cast<float>(row[kGyro[i]]);
      sample.accel_g[i] = static_cast<float>(accel_g_[i]);
    }
    const bool fresh = t_s - temperature_at_s_ <= kHoldS;
    sample.temp_degc = fresh ? static_cast<float>(imu_degc_) : std::nanf("");
    sample.elapsed = Elapsed(row);
    last_t_s_ = t_s;
    last_seq_ = row[Channel::kSeq];
    started_ = true;
    return sample;
  }

 private:
  void Hold(const Row& row) {
    if (!std::isnan(row[Channel::kImuTemperature])) {
      imu_degc_ = row[Channel::kImuTemperature];
      temperature_at_s_ = row[Channel::kTime];
    }
    if (AnyBlank(row, kAccel)) return;
    for (std::size_t i = 0; i < 3; ++i) accel_g_[i] = row[kAccel[i]];
    has_accel_ = true;
  }

  std::uint32_t Elapsed(const Row& row) {
    if (!started_) counted_s_ = row[Channel::kTime];
    if (!started_) return 1;
    if (rate_is_stated_) return ElapsedByCount(row[Channel::kTime]);
    const double periods = (row[Channel::kTime] - last_t_s_) * sample_hz_;
    const double by_seq = row[Channel::kSeq] - last_seq_;
    // A counter that wrapped or restarted says nothing: then time has to.
    if (by_seq >= 1 && by_seq < 2 * periods + 2) return static_cast<std::uint32_t>(by_seq);
    return periods > kGapPeriods ? static_cast<std::uint32_t>(std::fmin(periods + 0.5, 4e9)) : 1;
  }

  std::uint32_t ElapsedByCount(double t_s) {
    counted_s_ += 1 / sample_hz_;
    const double ahead_s = t_s - counted_s_;
    if (ahead_s <= kBurstS) {
      counted_s_ += kFollow * ahead_s;
      return 1;
    }
    counted_s_ = t_s;
    return 1 + static_cast<std::uint32_t>(std::fmin(ahead_s * sample_hz_ + 0.5, 4e9));
  }

  double sample_hz_;
  bool rate_is_stated_;
  double counted_s_ = 0;
  double imu_degc_ = std::nan(""), temperature_at_s_ = -std::numeric_limits<double>::infinity();
  std::array<double, 3> accel_g_{};
  double last_t_s_ = 0, last_seq_ = 0;
  bool has_accel_ = false, started_ = false;
};

class CsvInput final : public ReplayInput {
 public:
  CsvInput(std::filesystem::path path, ImportMap map)
      : path_(std::move(path)), map_(std::move(map)) {}

  /// Refuses what cannot be learned from; finds the sample rate.
  Status Survey() {
    auto source = CsvSource::Open(path_, map_);
    if (!source) return tl::unexpected(source.error());
    if (Status status = CheckChannels(*source); !status) return status;
    std::vector<double> steps_s;
    double last_t_s = std::nan("");
    while (steps_s.size() < kSurveySteps) {
      const auto row = source->Next();
      if (!row) return tl::unexpected(row.error());
      if (!*row) break;
      if (AnyBlank(**row, kGyro)) continue;
      const double t_s = (**row)[Channel::kTime];
      if (!std::isnan(last_t_s)) steps_s.push_back(t_s - last_t_s);
      last_t_s = t_s;
    }
    if (map_.sample_hz > 0) steps_s.assign(1, 1 / map_.sample_hz);
    const auto rate = SampleRate(path_, std::move(steps_s));
    if (!rate) return tl::unexpected(rate.error());
    sample_hz_ = *rate;
    return {};
  }

  Status Feed(ReplaySink& sink) override {
    auto source = CsvSource::Open(path_, map_);
    if (!source) return tl::unexpected(source.error());
    RowSampler sampler(sample_hz_, map_.sample_hz > 0);
    for (;;) {
      const auto row = source->Next();
      if (!row) return tl::unexpected(row.error());
      if (!*row) break;
      const auto sample = sampler.Take(**row);
      if (sample && !sink.OnSample((**row)[Channel::kTime], *sample)) break;
    }
    skipped_rows_ = source->skipped_rows();
    return {};
  }

 private:
  Status CheckChannels(const CsvSource& source) const {
    std::string missing;
    const auto want = [&](Channel channel, std::string_view why) {
      if (source.has(channel)) return;
      if (!missing.empty()) missing += "; ";
      missing += fmt::format("{} ({})", kChannelNames[Index(channel)], why);
    };
    want(Channel::kTime, "or a sample rate in the map");
    for (Channel channel : kGyro) want(channel, "raw gyro samples");
    for (Channel channel : kAccel) want(channel, "stillness");
    want(Channel::kImuTemperature, "what the table is over");
    if (missing.empty()) return {};
    return Fail(
        Error::Kind::kConfig,
        fmt::format("{}: learning needs columns that are not there: {}", path_.string(), missing));
  }

  std::filesystem::path path_;
  ImportMap map_;
};

}  // namespace

Result<std::unique_ptr<ReplayInput>> OpenCsvInput(const std::filesystem::path& csv,
                                                  const std::optional<std::filesystem::path>& map) {
  ImportMap import;
  if (map) {
    auto loaded = LoadImportMap(*map);
    if (!loaded) return tl::unexpected(loaded.error());
    import = std::move(*loaded);
  }
  auto input = std::make_unique<CsvInput>(csv, std::move(import));
  if (Status status = input->Survey(); !status) return tl::unexpected(status.error());
  return input;
}

}  // namespace zrobench
