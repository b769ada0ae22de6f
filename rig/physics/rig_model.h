#pragma once
// The physics run forward: plate, board, package, gyro and accelerometer as one state that is moved
// through time. rig/virtual puts it behind the driver interfaces; diagnose fits the same terms.
#include <cstdint>
#include <memory>

#include "core/result.h"
#include "rig/physics/model.h"

namespace zrobench::physics {

/// What acts on the rig from outside. Held constant between calls.
struct Inputs {
  double drive_pct = 0;  ///< plate, -100..100
  double tone_hz = 0;
  double tone_pa = 0;       ///< rms pressure at the package; 0 = silent
  double tone_band_hz = 0;  ///< 0 = a sine; else noise, flat over this width about tone_hz
  double load_w = 0;        ///< heat brought to the board, beside its own (thermal.self_heating)
  double load_pct = 0;      ///< how hard the board works, 0..100
  bool powered = true;      ///< the board has its supply
  double age_days = 0;      ///< of the part, for effects of months
  double supply_v = 3.3;
  Axes turn_dps{};          ///< true rotation rate (hand motion)
  Axes shake_g{};           ///< acceleration beside gravity (hand motion)
  Axes gravity_g{0, 0, 1};  ///< gravity in board axes
};

struct Temperatures {
  double plate_degc = 0, board_degc = 0, die_degc = 0;
};

/// What moves heat from outside, besides what the nodes exchange.
struct HeatFlows {
  double plate_w = 0;
  double board_w = 0;
  double die_k_per_s = 0;  ///< the package has no capacity of its own in the model
};

/// One instant of the sensors, before the board's quantisation and saturation.
struct Sensed {
  Axes rate_dps{};
  Axes accel_g{};
};

class RigModel {
 public:
  /// kConfig when the model is impossible (non-positive capacity, unknown term or parameter ...).
  /// `sample_hz` fixes the noise bandwidth; `seed` all randomness.
  static Result<RigModel> Make(const Model& model, double sample_hz, std::uint64_t seed);
  RigModel(RigModel&&) noexcept;
  RigModel& operator=(RigModel&&) noexcept;
  ~RigModel();

  /// Everything at the ambient temperature, the terms' masses, too. Noise goes on where it was.
  void Reset();
  /// Moves heat for `dt_s` with `inputs` held: exact for the linear network (matrix exponential).
  /// Cheap (10 ns) for the last eight lengths of step, some microseconds for a new one.
  void AdvanceHeat(double dt_s, const Inputs& inputs);
  /// Next sensor instant, one sample period after the last: noise moves on by one sample.
  /// Without [model.gyro] the rates are zero.
  Sensed SampleSensors(const Inputs& inputs);
  /// Start of a new power-on (turn-on effects restart).
  void PowerCycle();

  Temperatures temperatures() const;
  /// What the plate's and the die's sensors make of them, before quantisation.
  Temperatures shown_temperatures() const;
  /// True offset (cubic in T_d plus what terms add beside sound and motion), without noise.
  Axes TrueZro() const;
  /// For the energy balance: heat stored above ambient [J], and what flowed in from outside during
  /// the last step minus what is lost to ambient now [W].
  double StoredHeat() const;
  double NetHeatFlow() const;

 private:
  struct State;
  explicit RigModel(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace zrobench::physics
