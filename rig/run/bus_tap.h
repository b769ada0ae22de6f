#pragma once
// Turns the bus's frames into record items, in bus order, and adds the means over each second.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/imu/imu_board.h"
#include "rig/run/run_log.h"

namespace zrobench {

/// RAW, ACC and RATE of one sample become one ImuSample when the last of them is there. Other
/// frames that fall between them are written after it: the board handles them after the sample. A
/// sample without its ACC or RATE is written with zeros there, raises an alarm (kInputsLost, one a
/// second at most) and stays out of the means. So does a board whose counter goes backwards without
/// a boot: it raises the same alarm, for nobody knows what its corrector made of that.
class BusTap final : public FrameListener {
 public:
  /// `log` is borrowed.
  explicit BusTap(RunLog& log) : log_(log) {}
  void OnFrame(const CanFrame& frame) override;

  /// After the last frame: what still waits for a sample's end goes into the record. A sample that
  /// was cut off (the supply went) is left out.
  void Finish();

  /// Samples of which a part (ACC or RATE) never came: inputs of the corrector are missing.
  std::uint64_t incomplete_samples() const { return incomplete_; }

 private:
  enum Part : std::uint8_t { kRaw = 1, kAcc = 2, kRate = 4, kAll = 7 };

  bool TakePart(const CanFrame& frame, std::uint64_t at_us);
  void StartSample(std::uint64_t at_us, std::uint8_t seq);
  void FinishSample();
  void WriteHeld();
  void TellIncomplete(std::uint64_t at_us);
  void TakeOther(const CanFrame& frame, std::uint64_t at_us);
  void WatchBoardClock(std::uint32_t device_us);
  void AddToMean(const ImuSample& sample);

  RunLog& log_;
  ImuSample sample_;
  std::uint8_t parts_ = 0;
  std::vector<BusFrame> held_;
  std::uint64_t incomplete_ = 0;
  std::uint64_t incomplete_told_ = 0;
  std::uint64_t next_alarm_us_ = 0;

  struct Sums {
    std::uint64_t second = 0;
    std::array<double, 3> raw{}, rate{}, accel{};
    double temperature = 0;
    std::uint32_t n = 0;
  } sums_;
  std::optional<double> imu_degc_;          ///< absent until the first DUT_TIME
  std::optional<std::uint32_t> device_us_;  ///< of the last DUT_TIME of this boot
};

}  // namespace zrobench
