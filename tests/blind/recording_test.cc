// What is written can be read back, and its noise is the noise that visibility is measured in.
#include "tests/blind/recording.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "tests/blind/baselines.h"
#include "tests/blind/hidden_case.h"

namespace zrobench::blind {
namespace {

namespace fs = std::filesystem;

class WrittenCase : public testing::Test {
 protected:
  ~WrittenCase() override { fs::remove_all(folder_); }

  HiddenCase Write(const CaseOrder& order, std::uint64_t seed) {
    fs::create_directories(folder_);
    HiddenCase made = MakeCase(order, seed);
    std::ofstream(folder_ / "station.toml") << StationText(made.bench, made.schedules);
    for (std::size_t run = 0; run < made.schedules.size(); ++run) {
      std::ofstream(folder_ / ("run-" + std::to_string(run + 1) + ".csv"))
          << RunText(made, run, seed);
    }
    return made;
  }

  // Squared remainder of the base fit per sample, each channel, under the case's own noise.
  std::array<double, kChannels> EnergyOf(const HiddenCase& made) const {
    Recording recording = ReadCase(folder_);
    recording.bench.instruments = made.bench.instruments;
    Bench fitted = recording.bench;
    fitted.actual = FittedModel(recording);
    const Yardstick yard(fitted, recording.campaign);
    const Eigen::MatrixXd left = yard.Project(recording.stacked - yard.reference());
    std::array<double, kChannels> energy{};
    const double samples = static_cast<double>(left.rows()) / kChannels;
    for (Eigen::Index at = 0; at < left.rows(); ++at) {
      energy[static_cast<std::size_t>(at % kChannels)] += left(at, 0) * left(at, 0) / samples;
    }
    return energy;
  }

  // Each test is a process of its own, and several run at once.
  fs::path folder_ =
      fs::path(testing::TempDir()) / ("blind_recording_test-" + std::to_string(getpid()));
};

TEST_F(WrittenCase, OfANullHoldsTheStatedNoiseAndNoMore) {
  // Seeds in which the board is not turned during an edge, which a straight line cannot bridge.
  for (const std::uint64_t seed : {64U, 65U}) {
    for (const double energy : EnergyOf(Write(CaseOrder{}, seed))) {
      EXPECT_NEAR(energy, 1, 0.06) << seed;
    }
  }
}

TEST_F(WrittenCase, KeepsWhatWasDone) {
  const HiddenCase made = Write(CaseOrder{}, 62);
  const Recording read = ReadCase(folder_);
  ASSERT_EQ(read.campaign.schedules.size(), 4U);
  for (std::size_t run = 0; run < 4; ++run) {
    EXPECT_NEAR(
        (read.campaign.command_pct[run] - made.paths[run].command_pct).cwiseAbs().maxCoeff(), 0,
        0.0051);
    EXPECT_EQ(read.campaign.schedules[run].tone_hz, made.schedules[run].tone_hz);
    EXPECT_NEAR(read.campaign.schedules[run].started_h, made.schedules[run].started_h, 0.051);
  }
  EXPECT_EQ(read.bench.nominal.resonance_hz, made.bench.nominal.resonance_hz);
  EXPECT_NEAR(read.bench.nominal.zro_dps[1][1], made.bench.nominal.zro_dps[1][1], 1e-6);
}

TEST_F(WrittenCase, ThatIsCutShortIsRefused) {
  Write(CaseOrder{}, 63);
  for (const std::uintmax_t bytes : {5000, 4990, 4970}) {  // within a number, after a sign ...
    fs::resize_file(folder_ / "run-2.csv", bytes);
    EXPECT_THAT([this] { ReadCase(folder_); },
                testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("run-2.csv")));
  }
  EXPECT_THROW(ReadCase(folder_ / "nowhere"), std::exception);
}

}  // namespace
}  // namespace zrobench::blind
