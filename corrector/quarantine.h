#pragma once
// Persistent corruption or genuine shift? One slot of evidence, two speeds of belief.
#include <cstdint>

#include "corrector/types.h"

namespace zro {

/// Collects refused but clean readings, one a still period, as shifts from what the table expects.
/// The output follows a shift that a second still confirms (large ones: more stills); the table
/// changes only for one that keeps agreeing with itself over kVotes stills and kLeastS. A reading
/// that agrees with the table again ends both at once.
/// RAM only: a reboot forgets the evidence, never the table.
class Quarantine {
 public:
  static constexpr std::uint8_t kVotes = 6;
  static constexpr float kLeastS = 1800.0f;      ///< longer than noise or a ride lasts
  static constexpr float kExpireS = 86400.0f;    ///< without a new vote
  static constexpr std::uint8_t kVotesLone = 2;  ///< against a single, unconfirmed entry: its word
                                                 ///< is worth no more than the newcomer's
  static constexpr std::uint8_t kFollowVotes = 2;  ///< stills until the output follows ...
  static constexpr float kFollowEachDps = 0.3f;    ///< ... and one more for each of these

  enum class Verdict : std::uint8_t { kFirst, kAgrees, kReplaced, kConfirmed };

  /// `lone`: the table is one unconfirmed entry. `sigma_dps`: 1 sigma of the shift. `most_dps`:
  /// votes never lie farther apart than this. `clean`: its noise is known to be no more than the
  /// gyro's own; the output follows no others.
  struct Vote {
    float shift_dps[kAxes];
    float sigma_dps;
    float most_dps;
    std::uint32_t sample;
    bool lone;
    bool clean;
  };

  explicit Quarantine(float sample_hz);

  /// There is evidence and the vote is within the joint uncertainty of it.
  bool Agrees(const Vote& vote) const;
  Verdict Add(const Vote& vote);
  /// True when evidence was held and is too old now; it is dropped.
  bool Expire(std::uint32_t sample);
  /// Drops the evidence; true when there was some.
  bool Clear();

  std::uint8_t votes() const { return votes_; }
  const float* shift_dps() const { return shift_dps_; }
  /// The output is to follow shift_dps() meanwhile.
  bool follows() const { return follows_; }

 private:
  float shift_dps_[kAxes] = {};  ///< mean of the votes
  float sigma_dps_ = 0.0f;       ///< of the latest vote
  std::uint32_t first_ = 0;
  std::uint32_t last_ = 0;
  std::uint32_t least_samples_;
  std::uint32_t expire_samples_;
  std::uint8_t votes_ = 0;
  bool follows_ = false;
};

}  // namespace zro
