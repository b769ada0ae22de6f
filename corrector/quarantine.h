#pragma once
// Persistent corruption or genuine shift? One slot of evidence.
#include <cstdint>

#include "corrector/types.h"

namespace zro {

/// Collects refused but clean readings, one a still period, as shifts from what the table expects.
/// Only a shift that keeps agreeing with itself over kVotes still periods and kLeastS is believed.
/// RAM only: a reboot forgets the evidence, never the table.
class Quarantine {
 public:
  static constexpr std::uint8_t kVotes = 6;
  static constexpr float kLeastS = 1800.0f;      ///< longer than noise or a ride lasts
  static constexpr float kExpireS = 86400.0f;    ///< without a new vote
  static constexpr std::uint8_t kVotesLone = 2;  ///< against a single, unconfirmed entry: its word
                                                 ///< is worth no more than the newcomer's

  enum class Verdict : std::uint8_t { kFirst, kAgrees, kReplaced, kConfirmed };

  /// `lone`: the table is one unconfirmed entry. `tolerance_dps`: how far votes may lie apart.
  struct Vote {
    float shift_dps[kAxes];
    float tolerance_dps;
    std::uint32_t sample;
    bool lone;
  };

  explicit Quarantine(float sample_hz);

  Verdict Add(const Vote& vote);
  /// True when evidence was held and is too old now; it is dropped.
  bool Expire(std::uint32_t sample);
  /// Drops the evidence; true when there was some.
  bool Clear();

  std::uint8_t votes() const { return votes_; }
  const float* shift_dps() const { return shift_dps_; }

 private:
  float shift_dps_[kAxes] = {};  ///< mean of the votes
  std::uint32_t first_ = 0;
  std::uint32_t last_ = 0;
  std::uint32_t least_samples_;
  std::uint32_t expire_samples_;
  std::uint8_t votes_ = 0;
};

}  // namespace zro
