#pragma once
// Object 0x2101: what the bench may do to the board for a test, and its dead man's handle.
#include <cstdint>

#include "corrector/types.h"

namespace zro::node {

/// Locked and inactive after boot. The handle counts sample periods, not milliseconds: a host that
/// replays the bus then clears the modes at the very same sample. Freestanding.
class TestModes {
 public:
  static constexpr std::uint32_t kKey = 0x54534554;  ///< "TEST" as 0x2101:1 takes it

  /// The handle slips `periods` sample periods after the last rig heartbeat or unlock.
  explicit TestModes(std::uint32_t periods) : allowed_(periods) {}

  /// 0x2101:1. The key unlocks; 0 locks and clears all modes. False for any other value.
  bool Unlock(std::uint32_t key);
  /// 0x2101:2. Gyro LSB added to what the corrector sees, not to DUT_RAW. Needs unlocked().
  void SetInjection(const std::int16_t lsb[kAxes]);
  /// 0x2101:6. How hard the board works to warm itself [% of its time]; false above 100. Needs
  /// unlocked(). The corrector goes on as ever: real heat is no test value.
  bool SetLoad(std::uint8_t pct);
  void OnRigHeartbeat() { since_ = 0; }
  /// A sample that comes `elapsed` periods after the one before.
  void OnSample(std::uint32_t elapsed);

  bool unlocked() const { return unlocked_; }
  bool active() const { return injection_[0] != 0 || injection_[1] != 0 || injection_[2] != 0; }
  std::uint8_t load_pct() const { return load_pct_; }
  const std::int16_t* injection_lsb() const { return injection_; }

 private:
  void Clear();

  std::uint32_t allowed_;
  std::uint32_t since_ = 0;
  bool unlocked_ = false;
  std::int16_t injection_[kAxes] = {};
  std::uint8_t load_pct_ = 0;
};

}  // namespace zro::node
