#include "tests/unit/diagnose/bench_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/check.h"
#include "rig/physics/random.h"
#include "rig/physics/rig_model.h"
#include "rig/physics/sensor_word.h"

namespace zrobench::diagnose {
namespace {

constexpr int kSamples = 10;  ///< a second

double SetPoint_degc(int run, double t_s) {
  const double minute = t_s / 60;
  if (minute < 3) return 23;
  if (run % 2 == 0) return minute < 20 ? 55 : minute < 40 ? 15 : 40;
  const double phase = std::fmod(minute - 3, 38);
  return phase < 19 ? 12 + 2.4 * phase : 12 + 2.4 * (38 - phase);
}

/// A second's means.
class RowMean {
 public:
  void Add(Channel channel, double value) { row_[channel] = sum(channel) + value / kSamples; }
  Row row(double t_s) const {
    Row row = row_;
    row[Channel::kTime] = t_s;
    return row;
  }

 private:
  double sum(Channel channel) const { return std::isnan(row_[channel]) ? 0 : row_[channel]; }
  Row row_;
};

}  // namespace

Case BenchRecording::Make() const {
  Case made;
  made.station.name = "test bench";
  made.station.model = nominal;
  for (int number = 0; number < runs; ++number) {
    auto rig = physics::RigModel::Make(actual, kSamples, seed + static_cast<std::uint64_t>(number));
    ZROBENCH_CHECK(rig.has_value());
    CaseRun& run = made.runs.emplace_back();
    run.name = fmt::format("run-{}", number + 1);
    for (const Channel c :
         {Channel::kTime, Channel::kPlate, Channel::kDrive, Channel::kImuTemperature,
          Channel::kGyroX, Channel::kGyroY, Channel::kGyroZ, Channel::kSupply}) {
      run.present[Index(c)] = true;
    }
    physics::Inputs inputs;
    double integral_pct = 0;
    physics::RandomStream sensors(seed + static_cast<std::uint64_t>(number), 100);
    for (int t = 0; t < seconds; ++t) {
      const double error = SetPoint_degc(number, t) - rig->shown_temperatures().plate_degc;
      integral_pct = std::clamp(integral_pct + 0.3 * error, -60.0, 60.0);
      inputs.drive_pct = std::clamp(20 * error + integral_pct, -100.0, 100.0);
      inputs.supply_v = 3.3 + (t / 600 % 2 == 1 ? 0.1 : 0.0);
      RowMean mean;
      for (int i = 0; i < kSamples; ++i) {
        rig->AdvanceHeat(1.0 / kSamples, inputs);
        const physics::Sensed sensed = rig->SampleSensors(inputs);
        const physics::Temperatures shown = rig->shown_temperatures();
        mean.Add(Channel::kDrive, inputs.drive_pct);
        mean.Add(Channel::kSupply, inputs.supply_v);
        mean.Add(Channel::kPlate,
                 physics::Quantise(shown.plate_degc + 0.1 * sensors.Normal(), 0.01));
        mean.Add(Channel::kImuTemperature,
                 physics::Quantise(shown.die_degc + 0.1 * sensors.Normal(), 0.0039));
        mean.Add(Channel::kGyroX, sensed.rate_dps[0]);
        mean.Add(Channel::kGyroY, sensed.rate_dps[1]);
        mean.Add(Channel::kGyroZ, sensed.rate_dps[2]);
      }
      run.rows.push_back(mean.row(t + 1));
    }
  }
  return made;
}

void Write(const Case& loaded, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "station.toml") << "schema = 1\n[station]\nname = \"bench\"\n"
                                            "[recording]\nrows = \"mean\"\n"
                                            "[recording.started_h]\nrun-2 = 26.0\n";
  for (const CaseRun& run : loaded.runs) {
    std::ofstream out(folder / (run.name + ".csv"));
    std::string line;
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (run.present[c]) line += fmt::format("{}{}", line.empty() ? "" : ",", kChannelNames[c]);
    }
    out << line << ",remark\n";
    for (const Row& row : run.rows) {
      line.clear();
      for (std::size_t c = 0; c < kChannels; ++c) {
        if (!run.present[c]) continue;
        line += fmt::format("{}{:.6f}", line.empty() ? "" : ",", row.values[c]);
      }
      out << line << ",fine\n";
    }
  }
}

}  // namespace zrobench::diagnose
