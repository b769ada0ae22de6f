#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/result.h"
#include "corrector/types.h"

namespace zrobench {

/// Takes what a recording holds, in order.
class ReplaySink {
 public:
  virtual ~ReplaySink() = default;
  /// False: enough, the input stops.
  virtual bool OnSample(double t_s, const zro::Sample& sample) = 0;
  virtual void OnDate(std::uint16_t days) = 0;
  /// The board booted here: not committed is lost.
  virtual void OnBoot() = 0;
  /// The host asked the board to store its table (object 0x1010).
  virtual void OnStore() = 0;
};

/// A recording of raw samples. Feed() may be called again and begins at the start each time.
class ReplayInput {
 public:
  virtual ~ReplayInput() = default;
  /// kConfig or kFile when the recording turns out to be unreadable or unfit.
  virtual Status Feed(ReplaySink& sink) = 0;
  double sample_hz() const { return sample_hz_; }
  std::uint64_t skipped_rows() const { return skipped_rows_; }
  /// Canonical image of the store at the start, where the recording has one.
  const std::optional<std::vector<std::uint8_t>>& start_image() const { return start_image_; }

 protected:
  double sample_hz_ = 0;
  std::uint64_t skipped_rows_ = 0;
  std::optional<std::vector<std::uint8_t>> start_image_;
};

/// Opens a run folder, a ULog or a CSV and finds its sample rate. kConfig when it lacks what
/// learning needs: time or a stated rate, gyro, accelerometer, temperature, raw samples.
Result<std::unique_ptr<ReplayInput>> OpenReplayInput(
    const std::filesystem::path& recording, const std::optional<std::filesystem::path>& map);

/// The same over a CSV and over items (csv_input.cc, record_input.cc).
Result<std::unique_ptr<ReplayInput>> OpenCsvInput(const std::filesystem::path& csv,
                                                  const std::optional<std::filesystem::path>& map);
Result<std::unique_ptr<ReplayInput>> OpenRecordInput(const std::filesystem::path& ulog);

/// Median of the steps; 0 for none. Takes its argument apart.
double MedianStep(std::vector<double> steps_s);
/// 1 / median step, or kConfig when the rows come too slowly to be raw samples.
Result<double> SampleRate(const std::filesystem::path& recording, std::vector<double> steps_s);

}  // namespace zrobench
