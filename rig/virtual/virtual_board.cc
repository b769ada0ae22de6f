#include "rig/virtual/virtual_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "rig/physics/sensor_word.h"
#include "rig/physics/signal.h"

namespace zrobench {
namespace {

constexpr zro::node::Identity kIdentity{0, 1, 0, 1, 0x76697274, 1};  // build id "virt", serial 1
constexpr double kAccelLsb_g = 0.000125;
constexpr double kTemperatureLsb_degc = 1.0 / 256;
constexpr auto kBootTime = std::chrono::milliseconds(50);  ///< supply up to first sample

/// Code c of the full scale 125 * 2^c dps.
std::uint8_t RangeCode(double gyro_range_dps) {
  return static_cast<std::uint8_t>(std::lround(std::log2(gyro_range_dps / 125.0)));
}

}  // namespace

VirtualBoard::VirtualBoard(const Station& station, std::uint64_t seed, zro::node::FrameSink& sink)
    : settings_(station.virtual_rig),
      model_(station.model),
      config_(zro::ConfigFor(
          static_cast<float>(settings_.sample_hz),
          static_cast<float>(
              station.model.gyro.value_or(physics::GyroModel{}).noise_density_dps_per_rthz))),
      sink_(sink),
      range_code_(RangeCode(settings_.gyro_range_dps)) {
  ShipFromFactory(seed);
}

void VirtualBoard::ShipFromFactory(std::uint64_t seed) {
  if (settings_.factory_degc.empty() || !model_.gyro) return;
  std::mt19937_64 generator(seed ^ 0xFAC7);
  const double scale = settings_.factory_error_dps * std::sqrt(3.0);  // uniform of that rms
  const auto error = [&] {
    return scale * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
  };
  zro::Corrector line(config_, &flash_);
  line.Boot();
  for (const double degc : settings_.factory_degc) {
    const physics::Axes zro_dps = physics::CubicOffset(*model_.gyro, degc);
    std::array<float, 3> measured{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      measured[axis] = static_cast<float>(zro_dps[axis] + error());
    }
    line.AddFactoryEntry(static_cast<float>(degc), measured.data(),
                         static_cast<float>(std::max(settings_.factory_error_dps, 1e-3)));
  }
  line.Commit();
}

void VirtualBoard::StartNode(zro::node::BootReason reason) {
  counter_ = 0;
  samples_since_boot_ = 0;
  node_.emplace(kIdentity, config_, &flash_, &sink_, zro::node::TimeDividerFor(config_.sample_hz));
  node_->Boot(reason, ++boot_count_);
}

void VirtualBoard::PowerOn(Instant now) {
  if (on()) return;
  booted_ = now + kBootTime;
  next_sample_ = booted_;
  StartNode(zro::node::BootReason::kPowerOn);
}

void VirtualBoard::PowerOff() {
  node_.reset();
  next_sample_ = Instant::max();
}

zro::node::RawSample VirtualBoard::Quantise(const physics::Sensed& sensed, double die_degc) {
  zro::node::RawSample raw{};
  const double gyro_lsb_dps = settings_.gyro_range_dps / 32768;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    raw.gyro[axis] = physics::QuantiseToWord(sensed.rate_dps[axis], gyro_lsb_dps).word;
    const auto accel = physics::QuantiseToWord(sensed.accel_g[axis], kAccelLsb_g);
    raw.accel[axis] = accel.word;
    raw.accel_clipped = raw.accel_clipped || accel.clipped;
  }
  const double resolution_degc =
      model_.package ? model_.package->resolution_degc : kTemperatureLsb_degc;
  raw.temperature =
      physics::QuantiseToWord(physics::Quantise(die_degc, resolution_degc), kTemperatureLsb_degc)
          .word;
  raw.counter = counter_++;
  raw.range_code = range_code_;
  return raw;
}

void VirtualBoard::Sample(const physics::Sensed& sensed, double die_degc) {
  ++samples_since_boot_;
  const double since_boot_s = static_cast<double>(samples_since_boot_) / settings_.sample_hz;
  next_sample_ = booted_ + FromSeconds(since_boot_s);
  node_->OnSample(Quantise(sensed, die_degc));
  node_->OnTime(static_cast<std::uint32_t>(since_boot_s * 1e3));
}

void VirtualBoard::Deliver(const zro::node::Frame& frame) {
  if (!on()) return;
  node_->OnFrame(frame);
  if (!node_->reset_requested()) return;
  booted_ = next_sample_;
  StartNode(zro::node::BootReason::kSoftware);
}

}  // namespace zrobench
