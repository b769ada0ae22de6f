#pragma once
// A device with known truth, and a corrector on it: the tests' workbench. Deterministic by seed.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "corrector/corrector.h"

namespace zro::test {

using Vector = std::array<double, 3>;

/// Offset of a consumer gyro over temperature: cubics about 25 degC.
inline Vector TrueOffset(double temp_degc) {
  const double d = temp_degc - 25.0;
  return {0.8 + 0.030 * d - 4e-4 * d * d + 1e-5 * d * d * d, -1.1 - 0.022 * d + 5e-4 * d * d,
          0.35 + 0.012 * d + 2e-4 * d * d - 6e-6 * d * d * d};
}

/// Flash in RAM. Fails, or loses power, where told.
class RamStorage final : public Storage {
 public:
  RamStorage() {
    for (auto& slot : slots) slot.assign(Store::kSlotBytes, 0xFF);
  }
  bool Read(int slot, std::uint8_t* out, std::size_t size) override {
    if (fail_reads) return false;
    std::memcpy(out, slots[static_cast<std::size_t>(slot)].data(), size);
    return true;
  }
  bool Write(int slot, const std::uint8_t* data, std::size_t size) override {
    ++writes;
    if (fail_writes) return false;
    const std::size_t kept = cut_at < size ? cut_at : size;
    std::memcpy(slots[static_cast<std::size_t>(slot)].data(), data, kept);
    if (worn) slots[static_cast<std::size_t>(slot)][100] ^= 4;
    return true;
  }

  std::array<std::vector<std::uint8_t>, kSlots> slots;
  std::size_t cut_at = SIZE_MAX;  ///< bytes written before the power goes
  bool fail_reads = false;
  bool fail_writes = false;
  bool worn = false;  ///< a bit does not keep what was written
  int writes = 0;     ///< tried
};

struct Noise {
  double gyro_dps = 0.05;
  double accel_g = 0.002;
  double temp_degc = 0.0;
};

/// What is done to the device at a time.
struct Scene {
  double temp_degc = 25.0;
  Vector extra_dps = {0, 0, 0};  ///< seen by the gyro beside its offset
  double noise_factor = 1.0;
  bool shaken = false;  ///< gross motion, seen by both sensors
};
using Script = std::function<Scene(double t_s)>;

class Bench {
 public:
  explicit Bench(Config config = Config{}, std::uint64_t seed = 1)
      : config_(config), rng_(seed), corrector_(config, &storage) {
    corrector_.Boot();
  }

  /// Adds factory entries with the truth plus these errors in turn.
  void AddFactory(const std::vector<double>& temps_degc, double error_dps = 0.005) {
    double sign = 1.0;
    for (const double temp : temps_degc) {
      const Vector truth = TrueOffset(temp);
      float zro[3];
      for (std::size_t i = 0; i < 3; ++i) {
        zro[i] = static_cast<float>(truth[i] + sign * error_dps);
        sign = -sign;
      }
      corrector_.AddFactoryEntry(static_cast<float>(temp), zro, 0.005f);
    }
    corrector_.Commit();
  }

  Sample Make(const Scene& scene) {
    if (ticks_++ % 10 == 0) {
      shown_degc_ = std::round((scene.temp_degc + noise.temp_degc * Normal()) * 256.0) / 256.0;
    }
    const Vector truth = TrueOffset(scene.temp_degc);
    Sample s{};
    for (std::size_t i = 0; i < 3; ++i) {
      double rate = truth[i] + scene.extra_dps[i];
      double accel = i == 2 ? 1.0 : 0.0;
      if (scene.shaken) {
        rate += 60.0 * std::sin(6.28 * (0.3 + 0.2 * static_cast<double>(i)) * t_s);
        accel += 0.15 * std::sin(6.28 * (0.7 + 0.3 * static_cast<double>(i)) * t_s);
      }
      s.rate_dps[i] = static_cast<float>(rate + noise.gyro_dps * scene.noise_factor * Normal());
      s.accel_g[i] = static_cast<float>(accel + noise.accel_g * Normal());
    }
    s.temp_degc = static_cast<float>(shown_degc_);
    s.elapsed = 1;
    return s;
  }

  Output Step(const Sample& sample) {
    const Output out = corrector_.Step(sample);
    t_s += 1.0 / static_cast<double>(config_.sample_hz);
    Event event;
    while (corrector_.PopEvent(&event)) events.push_back(event);
    return out;
  }

  /// Runs the script (its own time starts at 0); calls `watch` after each sample if given.
  void Run(double for_s, const Script& script,
           const std::function<void(const Scene&, const Output&)>& watch = {}) {
    const auto n = static_cast<std::int64_t>(for_s * static_cast<double>(config_.sample_hz) + 0.5);
    for (std::int64_t i = 0; i < n; ++i) {
      const Scene scene = script(static_cast<double>(i) / static_cast<double>(config_.sample_hz));
      const Output out = Step(Make(scene));
      if (watch) watch(scene, out);
    }
  }
  void Rest(double for_s, double temp_degc = 25.0, Vector extra_dps = {0, 0, 0}) {
    Run(for_s, [&](double) { return Scene{temp_degc, extra_dps}; });
  }
  void Shake(double for_s, double temp_degc = 25.0) {
    Run(for_s, [&](double) { return Scene{temp_degc, {0, 0, 0}, 1.0, true}; });
  }

  int Count(Code code) const {
    int n = 0;
    for (const Event& e : events) n += e.code == code ? 1 : 0;
    return n;
  }
  int Writes() const {
    return Count(Code::kNew) + Count(Code::kMerged) + Count(Code::kOverwroteOld) +
           Count(Code::kShiftConfirmed);
  }
  std::vector<Code> Codes() const {
    std::vector<Code> codes;
    for (const Event& e : events) codes.push_back(e.code);
    return codes;
  }
  /// Greatest difference of any axis between the table's offset and the truth there.
  double ErrorAt(double temp_degc) const {
    const Estimate e = corrector_.table().At(static_cast<float>(temp_degc));
    const Vector truth = TrueOffset(temp_degc);
    double worst = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      worst = std::max(worst, std::abs(static_cast<double>(e.zro_dps[i]) - truth[i]));
    }
    return worst;
  }
  Corrector& corrector() { return corrector_; }
  const Table& table() const { return corrector_.table(); }
  double Normal() { return normal_(rng_); }

  Noise noise;
  RamStorage storage;
  std::vector<Event> events;
  double t_s = 0.0;

 private:
  Config config_;
  std::mt19937_64 rng_;
  std::normal_distribution<double> normal_;
  Corrector corrector_;
  double shown_degc_ = 25.0;
  std::uint64_t ticks_ = 0;
};

}  // namespace zro::test
